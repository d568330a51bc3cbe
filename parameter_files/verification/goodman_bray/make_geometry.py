#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Sixteen columns on a stepped base that dips 30 degrees to the left.

Every column has points and lines of its own: the sides of neighbours touch
over unequal lengths.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from block_geometry import Geometry  # noqa: E402

WIDTH, STEP, DIP = 10.0, 1.0, np.radians(30)
HEIGHTS = [4.0 * i for i in range(1, 11)] + [33.8, 27.6, 21.4, 15.2, 9.0, 2.8]


def turned(polygon):
    c, s = np.cos(DIP), np.sin(DIP)
    return np.asarray(polygon, float) @ np.array([[c, s], [-s, c]])


def columns():
    """Columns from the toe up; x along the dip, y normal to it."""
    for i, height in enumerate(HEIGHTS):
        x, y = i * WIDTH, i * STEP
        yield [(x, y), (x + WIDTH, y), (x + WIDTH, y + height),
               (x, y + height)]


def base():
    n = len(HEIGHTS)
    polygon = [(-3 * WIDTH, -WIDTH), ((n + 1) * WIDTH, -WIDTH),
               ((n + 1) * WIDTH, n * STEP)]
    for i in range(n, 0, -1):
        polygon += [(i * WIDTH, i * STEP), (i * WIDTH, (i - 1) * STEP)]
    return polygon + [(-3 * WIDTH, 0)]


def main():
    geometry = Geometry("Toppling slope of Goodman and Bray, 16 columns.")
    geometry.add("base", turned(base()), shared=False)
    for column in columns():
        geometry.add("column", turned(column), shared=False)
    geometry.write(os.path.join(HERE, "goodman_bray.geo"))


if __name__ == "__main__":
    main()
