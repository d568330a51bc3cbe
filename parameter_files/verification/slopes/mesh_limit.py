#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Factor of safety of the vertical cut in clay that its mesh allows.

Of all velocities of the nodes of a mesh of crossed triangles that keep the
volume of each triangle, those that dissipate least for the power of gravity: the
least upper bound of limit analysis (kinematic theorem) with these elements.
Cohesion times the deviator of the strain rate is minimised by least squares,
with weights that come from the last solution. Triangles without change of volume
are asked for by a penalty. What quoin finds on the same mesh must be this number,
not the exact one of the continuum. Needs scipy (python3-scipy).
"""
import sys

import numpy as np
from scipy.sparse import bmat, csr_matrix, diags
from scipy.sparse.linalg import splu

WEIGHT, COHESION = 20e3, 12e3           # [N/m^3], [Pa]; the cut is 1 m high
LEFT, RIGHT, DEPTH = -0.5, 1.25, 0.25   # sides and bottom of cut.geo [m]
PENALTY = 1e6                           # of volume, by the largest weight


def crossed_mesh(n):
    """Nodes and triangles of squares of 1/n m, each cut by its diagonals."""
    h, number, points, triangles = 1 / n, {}, [], []

    def node(x, y):
        key = (round(2 * x), round(2 * y))
        if key not in number:
            number[key] = len(points)
            points.append((x * h, y * h))
        return number[key]

    for i in range(round(LEFT * n), round(RIGHT * n)):
        for j in range(-round(DEPTH * n), n):
            if i < 0 <= j:
                continue
            corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1),
                       node(i, j + 1)]
            middle = node(i + 0.5, j + 0.5)
            triangles += [(corners[k], corners[(k + 1) % 4], middle)
                          for k in range(4)]
    return np.array(points), np.array(triangles)


def gradients(points, triangles):
    """Areas, and the matrices that differentiate nodal values by x and y."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (c - a)[:, 0] * (b - a)[:, 1])
    opposite = np.stack([c - b, a - c, b - a], axis=1) / (2 * area)[:, None,
                                                                    None]
    row = np.repeat(np.arange(len(triangles)), 3)
    shape = (len(triangles), len(points))
    return area, [csr_matrix((sign * opposite[:, :, d].ravel(),
                              (row, triangles.ravel())), shape)
                  for d, sign in ((1, -1.0), (0, 1.0))]


def factor(n):
    points, triangles = crossed_mesh(n)
    area, (dx, dy) = gradients(points, triangles)
    count = len(points)
    x, y = points.T
    bottom = np.isclose(y, -DEPTH)
    fixed = np.concatenate([bottom | np.isclose(x, LEFT) | np.isclose(x, RIGHT),
                            bottom])
    load = np.zeros(2 * count)
    for k in range(3):
        np.add.at(load, count + triangles[:, k], -WEIGHT * area / 3)
    deviator = bmat([[dx, -dy], [dy, dx]]).tocsc()[:, ~fixed]
    volume = bmat([[dx, dy]]).tocsc()[:, ~fixed]
    load = load[~fixed]
    kept = PENALTY * volume.T @ diags(area) @ volume

    weight, least = np.ones(len(area)), np.inf
    for iteration in range(400):
        scaled = area * weight / weight.max()
        matrix = deviator.T @ diags(np.tile(scaled, 2)) @ deviator
        v = splu((matrix + kept / 1e2).tocsc(),
                 permc_spec="MMD_AT_PLUS_A").solve(load)
        v /= load @ v
        rate = np.hypot(*np.split(deviator @ v, 2))
        before, least = least, COHESION * area @ rate
        if iteration > 120 and abs(before - least) < 1e-6 * least:
            break
        floor = rate.max() * max(1e-5, 0.3 * 0.93**iteration)
        weight = 1 / np.hypot(rate, floor)
    return least, COHESION * area @ np.abs(volume @ v)


if __name__ == "__main__":
    for n in [int(word) for word in sys.argv[1:]] or [8, 16, 48]:
        least, left = factor(n)
        print("%3d squares a metre: factor of safety %.4f; change of volume "
              "left %.0e" % (n, least, left))
