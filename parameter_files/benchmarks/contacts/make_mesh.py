#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes a stack of square blocks on a base as a gmsh mesh.

  make_mesh.py ROWS COLUMNS FILE.msh

Blocks of 1 m, two triangles each, in stretcher bond with open head joints of
20 mm: each block stands on two others, so that there are two pairs of touching
edges for each block and no nodes match. Format 2.2, written directly because
gmsh takes long over many surfaces.
"""
import sys

import numpy as np

HEAD = 0.02                        # width of the head joints [m]
BASE = 0.5                         # thickness of the base [m]


def squares(x, y, width, height):
    """Corners of rectangles, anticlockwise."""
    corner = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    return (np.stack([x, y], axis=1)[:, None]
            + corner * [width, height]).reshape(-1, 2)


def write(rows, columns, path):
    pitch = 1 + HEAD
    row, column = np.divmod(np.arange(rows * columns), columns)
    points = squares((column + 0.5 * (row % 2)) * pitch, row.astype(float),
                     1, 1)
    first = 4 * np.arange(rows * columns)[:, None]
    stone = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])

    # the base is one block of as many squares, and one more at either end
    n, m = len(points), columns + 3
    x = (np.arange(m + 1) - 1) * pitch
    points = np.vstack([points, np.stack([x, 0 * x - BASE], axis=1),
                        np.stack([x, 0 * x], axis=1)])
    lower = n + np.arange(m)[:, None]
    upper = lower + m + 1
    base = np.concatenate([np.hstack([lower, lower + 1, upper + 1]),
                           np.hstack([lower, upper + 1, upper])])

    with open(path, "w") as stream:
        stream.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n'
                     '$PhysicalNames\n2\n2 1 "stone"\n2 2 "base"\n'
                     '$EndPhysicalNames\n')
        stream.write("$Nodes\n%d\n" % len(points))
        stream.writelines("%d %.9g %.9g 0\n" % (k, x, y) for k, (x, y)
                          in enumerate(points.tolist(), start=1))
        stream.write("$EndNodes\n$Elements\n%d\n" % (len(stone) + len(base)))
        element = 0
        for group, triangles in ((1, stone), (2, base)):
            for a, b, c in (triangles + 1).tolist():
                element += 1
                stream.write("%d 2 2 %d %d %d %d %d\n"
                             % (element, group, group, a, b, c))
        stream.write("$EndElements\n")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    write(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
