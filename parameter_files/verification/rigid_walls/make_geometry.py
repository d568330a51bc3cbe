#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Two walls in running bond, 5 bricks wide, of 6 and of 10 courses.

The first course and every second one begin and end with a half brick. Bricks
share their lines with their neighbours and with the ground.
"""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from block_geometry import Geometry  # noqa: E402

BRICKS, LENGTH, HEIGHT = 5, 0.4, 0.175
WALLS = {"wall_1": 6, "wall_2": 10}


def courses(number):
    """Bricks of each course, as (left, right, bottom, top)."""
    for i in range(number):
        x = [k * LENGTH for k in range(BRICKS + 1)]
        if i % 2 == 0:
            x = ([0.0] + [(k + 0.5) * LENGTH for k in range(BRICKS)]
                 + [BRICKS * LENGTH])
        yield [(a, b, i * HEIGHT, (i + 1) * HEIGHT)
               for a, b in zip(x, x[1:])]


def rectangle(left, right, bottom, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def main():
    for name, number in WALLS.items():
        geometry = Geometry("Wall of Ferris and Tin-Loi, %d courses." % number)
        geometry.add("ground", rectangle(0, BRICKS * LENGTH, -HEIGHT, 0))
        for course in courses(number):
            for brick in course:
                geometry.add("brick", rectangle(*brick))
        geometry.write(os.path.join(HERE, name + ".geo"))


if __name__ == "__main__":
    main()
