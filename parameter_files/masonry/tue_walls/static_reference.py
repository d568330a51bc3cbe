#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Elastic lateral stiffness of a wall by static finite elements.

  static_reference.py OUTPUT_DIR [--mortar 82e9,36e9] [--crack 1e13,1e13]

Takes only the mesh from a run: reference positions, triangles, and which joint
set each joint face belongs to. Linear triangles and joint springs, two at each
face, are assembled anew and solved at once (numpy, dense), with the lower beam
held and the upper one pushed sideways.
"""
import argparse
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                *[os.pardir] * 3, "python"))
from quoin import vtu  # noqa: E402

YOUNG, POISSON, THICKNESS = 16.7e9, 0.15, 0.1
MORTAR = (82e9, 36e9)
CRACK = (1e13, 1e13)


def triangle_stiffness(corners):
    """6 x 6, plane stress; corners 3 x 2."""
    D = YOUNG / (1 - POISSON**2) * np.array(
        [[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]])
    x, y = corners.T
    double_area = ((x[1] - x[0]) * (y[2] - y[0])
                   - (x[2] - x[0]) * (y[1] - y[0]))
    B = np.zeros((3, 6))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        dx, dy = (y[j] - y[k]) / double_area, (x[k] - x[j]) / double_area
        B[:, 2 * i:2 * i + 2] = [[dx, 0], [0, dy], [dy, dx]]
    return B.T @ D @ B * abs(double_area) / 2 * THICKNESS


def key(point):
    return tuple(np.round(point * 1e5).astype(int))


def outer_edges(points, cells):
    """{middle: [(a, b), ...]} of the edges that bound blocks."""
    directed = {}
    for cell in cells:
        for i in range(3):
            a, b = cell[i], cell[(i + 1) % 3]
            directed.setdefault(frozenset((a, b)), []).append((a, b))
    result = {}
    for edge in directed.values():
        if len(edge) == 1:
            a, b = edge[0]
            result.setdefault(key((points[a] + points[b]) / 2),
                              []).append((a, b))
    return result


def stiffness(output, mortar=MORTAR, crack=CRACK):
    """Horizontal force by displacement of the upper beam [N/m]."""
    grid = vtu.read_at(os.path.join(output, "blocks.pvd"))
    joints = vtu.read_at(os.path.join(output, "joints.pvd"))
    points, cells, n = grid.points, grid.cells, len(grid.points)
    K = np.zeros((2 * n, 2 * n))
    for cell in cells:
        dofs = np.ravel(np.column_stack([2 * cell, 2 * cell + 1]))
        K[np.ix_(dofs, dofs)] += triangle_stiffness(points[cell])

    place = joints.points - joints.point_data["displacement"][:, :2]
    middles = place.reshape(-1, 2, 2).mean(axis=1)
    sets = {key(m): s for m, s in zip(middles, joints.cell_data["joint set"])}
    for middle, edges in outer_edges(points, cells).items():
        if len(edges) != 2:
            continue
        (a, b), (c, d) = edges
        normal, shear = mortar if sets[middle] == 0 else crack
        vertical = abs(points[a][0] - points[b][0]) < 1e-9
        area = np.linalg.norm(points[a] - points[b]) * THICKNESS / 2
        for p, q in ((a, d), (b, c)):
            for axis in range(2):
                k = area * (normal if (axis == 0) == vertical else shear)
                dofs = [2 * p + axis, 2 * q + axis]
                K[np.ix_(dofs, dofs)] += k * np.array([[1, -1], [-1, 1]])

    top, bottom = np.zeros(n, bool), np.zeros(n, bool)
    height = points[:, 1].max() - 0.0625
    for cell in cells:
        y = points[cell, 1].mean()
        top[cell] |= y > height
        bottom[cell] |= y < 0
    u = np.zeros(2 * n)
    u[0::2][top] = 1.0
    held = np.repeat(top | bottom, 2)
    u[~held] = np.linalg.solve(K[np.ix_(~held, ~held)],
                               -K[np.ix_(~held, held)] @ u[held])
    return (K @ u)[0::2][top].sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output")
    for name, values in (("mortar", MORTAR), ("crack", CRACK)):
        parser.add_argument("--" + name, default=values,
                            type=lambda t: tuple(map(float, t.split(","))),
                            help="normal and shear stiffness [Pa/m]")
    options = parser.parse_args()
    print("%.2f kN/mm" % (stiffness(options.output, options.mortar,
                                    options.crack) / 1e6))


if __name__ == "__main__":
    main()
