#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Accelerations [g] at which walls of two wythes overturn, by limit analysis: with
headers, without them and as one block; see README.md.

Needs scipy (Debian's python3-scipy).
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE)]
from space_limit_analysis import Boxes, SpaceLimitAnalysis  # noqa: E402

LENGTH, COURSES, HEIGHT, LEAF = 0.48, 7, 0.12, 0.12
WHOLE = [0, 0.24, 0.48], [0, 0.12, 0.36, 0.48]  # of odd and even courses
HEADERS = [0, 0.12, 0.18, 0.30, 0.42, 0.48]     # a header, a quarter, headers


def wall(header_courses):
    boxes = Boxes()
    for course in range(1, COURSES + 1):
        header = course in header_courses
        z = (course - 1) * HEIGHT
        ends = HEADERS if header else WHOLE[(course + 1) % 2]
        for leaf in ((0, 2 * LEAF),) if header else ((0, LEAF),
                                                     (LEAF, 2 * LEAF)):
            for left, right in zip(ends, ends[1:]):
                boxes.add((left, leaf[0], z), (right, leaf[1], z + HEIGHT),
                          fixed=course == 1)
    return boxes


def main():
    columns, loads = [], []
    for name, headers in (("tied", (4, 7)), ("untied", ())):
        # wythes slip on each other without friction
        found = [SpaceLimitAnalysis(
            wall(headers), np.tan(np.radians([angle, 0, angle])), (0, 1, 0),
            sides=16).associative() for angle in (35, 30, 50)]
        print("%s: %.5f, friction angles of 30 and 50 degrees %.5f, %.5f"
              % (name, *found))
        columns.append(name + " [-]")
        loads.append(found[0])
    above = (COURSES - 1) * HEIGHT
    print("one leaf by hand %.5f, one block %.5f"
          % (LEAF / above, 2 * LEAF / above))
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write(",".join(columns) + "\n%.6g,%.6g\n" % tuple(loads))
    # all of it, on its base
    weight = 2000 * 9.81 * LENGTH * 2 * LEAF * COURSES * HEIGHT
    with open(os.path.join(HERE, "reference_weight.csv"), "w") as stream:
        stream.write("time [s],weight [N]\n2,%.9g\n" % weight)


if __name__ == "__main__":
    main()
