#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Column of seven drums of equal height and a capital, on a wide base."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from block_geometry import Geometry  # noqa: E402

HEIGHT, CAPITAL, DRUMS = 5.95, 0.21, 7
FOOT, NECK = 1.11, 0.90  # width of the shaft below and above


def blocks():
    """Trapezia (lower width, upper width, bottom, top), from below."""
    shaft = HEIGHT - CAPITAL
    levels = [shaft * k / DRUMS for k in range(DRUMS + 1)]
    widths = [FOOT + (NECK - FOOT) * y / shaft for y in levels]
    drums = list(zip(widths, widths[1:], levels, levels[1:]))
    return drums + [(NECK, NECK, shaft, HEIGHT)]


def main():
    geometry = Geometry("Column of seven drums and a capital.")
    geometry.add("base", [(-4, -1), (4, -1), (4, 0), (-4, 0)], shared=False)
    for a, b, bottom, top in blocks():
        geometry.add("drum", [(-a / 2, bottom), (a / 2, bottom),
                              (b / 2, top), (-b / 2, top)])
    geometry.write(os.path.join(HERE, "column_overturning.geo"))


if __name__ == "__main__":
    main()
