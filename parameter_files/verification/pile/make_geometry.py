#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes pile.geo: irregular convex blocks hung loosely over a box.

The circumscribed circles of the blocks are let down one by one to the lowest
place that is free, so that the blocks are near each other and do not touch.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
SEED = 12
N_BLOCKS, N_NEEDLES, N_DEFORMABLE = 200, 8, 10
SMALLEST, RATIO = 0.1, 3.0         # circumradius [m], largest to smallest
HALF_WIDTH, WALL = 2.0, 0.5        # of the box: inner half, thickness [m]
GAP = 0.02                         # between circles [m]
MESH_DEFORMABLE = 0.2              # edge length [m]

random = np.random.default_rng(SEED)


def polygon(n_corners):
    """Corners on an ellipse: convex whatever the angles. None is nearer to
    the next than half of the regular distance."""
    share = 0.5 / n_corners + 0.5 * random.dirichlet([3.0] * n_corners)
    angle = 2 * np.pi * np.cumsum(share)
    return np.stack([np.cos(angle), random.uniform(0.7, 1) * np.sin(angle)],
                    axis=1)


def needle():
    """Eight times as long as it is wide, and tapering."""
    w = 1 / 8
    return np.array([[-1, -w], [1, -w / 2], [1, w / 2], [-1, w]])


def centred(corners):
    """About the centroid, in a random direction."""
    x, y = corners.T
    xn, yn = np.roll(corners, -1, axis=0).T
    cross = x * yn - xn * y
    centre = np.array([((x + xn) * cross).sum(), ((y + yn) * cross).sum()])
    corners = corners - centre / (3 * cross.sum())
    c, s = np.cos(a := random.uniform(0, 2 * np.pi)), np.sin(a)
    return corners @ np.array([[c, s], [-s, c]])


def shapes():
    """(corners, 'soft' or 'stone'), in random order."""
    result = []
    for i in range(N_BLOCKS):
        if i < N_NEEDLES:
            corners = needle() * SMALLEST * RATIO
        else:
            # of the deformable ones, none is so small that it slows the rest
            size = random.uniform(0.6 if i < N_NEEDLES + N_DEFORMABLE else 0,
                                  1)
            corners = polygon(random.integers(3, 8)) * SMALLEST * RATIO**size
        soft = N_NEEDLES <= i < N_NEEDLES + N_DEFORMABLE
        result.append((centred(corners), "soft" if soft else "stone"))
    random.shuffle(result)
    return result


def placed(blocks):
    """The blocks moved to their places."""
    circles, result = np.empty((0, 3)), []
    for corners, group in blocks:
        r = np.linalg.norm(corners, axis=1).max()
        reach = HALF_WIDTH - r - GAP
        best = (np.inf, 0.0)
        for x in random.uniform(-reach, reach, 60):
            apart = circles[:, 2] + r + GAP
            under = apart**2 - (circles[:, 0] - x) ** 2
            above = under > 0
            y = (circles[above, 1] + np.sqrt(under[above])).max(
                initial=r + GAP)
            best = min(best, (y, x))
        y, x = best
        circles = np.vstack([circles, [x, y, r]])
        result.append((corners + [x, y], group))
    return result


def rectangle(x0, y0, x1, y1):
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])


def main():
    blocks = placed(shapes())
    top = max(corners[:, 1].max() for corners, _ in blocks) + WALL
    b, w, slit = HALF_WIDTH, WALL, 1e-3
    blocks += [(rectangle(-b - w, -w, b + w, 0), "box"),
               (rectangle(-b - w, slit, -b, top), "box"),
               (rectangle(b, slit, b + w, top), "box")]
    size = {"stone": 10.0, "soft": MESH_DEFORMABLE, "box": 0.5}

    lines = ["// Written by make_geometry.py: irregular blocks over a box.",
             "Mesh.MeshSizeExtendFromBoundary = 1;"]
    groups, point = {}, 0
    for surface, (corners, group) in enumerate(blocks, start=1):
        n = len(corners)
        for k, (x, y) in enumerate(corners, start=1):
            lines.append("Point(%d) = {%.5f, %.5f, 0, %g};"
                         % (point + k, x, y, size[group]))
        for k in range(n):
            lines.append("Line(%d) = {%d, %d};"
                         % (point + k + 1, point + k + 1,
                            point + (k + 1) % n + 1))
        lines.append("Curve Loop(%d) = {%d:%d};"
                     % (surface, point + 1, point + n))
        lines.append("Plane Surface(%d) = {%d};" % (surface, surface))
        groups.setdefault(group, []).append(surface)
        point += n
    for group, surfaces in groups.items():
        rows = [", ".join(map(str, surfaces[i:i + 15]))
                for i in range(0, len(surfaces), 15)]
        lines.append('Physical Surface("%s") = {\n  %s};'
                     % (group, ",\n  ".join(rows)))
    with open(os.path.join(HERE, "pile.geo"), "w") as stream:
        stream.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
