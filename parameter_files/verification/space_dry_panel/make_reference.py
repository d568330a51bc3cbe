#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Acceleration [g] at which the panel collapses: writes reference.csv by limit
analysis and reference_no_dilation.csv by rigid blocks on springs; see README.md.

Needs scipy (Debian's python3-scipy), and a minute.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE)]
from space_limit_analysis import (Boxes, RigidBlocksOnSprings,  # noqa: E402
                                  SpaceLimitAnalysis)

LENGTH, COURSES, UNIT, HEIGHT, THICKNESS = 0.72, 5, 0.24, 0.12, 0.12
FRICTION_ANGLE, STIFFNESS, WEIGHT = 35, 5e9, 2000 * 9.81


def panel():
    boxes = Boxes()
    for course in range(COURSES):
        first = UNIT if course % 2 == 0 else UNIT / 2
        ends = [0.0, *np.arange(first, LENGTH - 1e-9, UNIT), LENGTH]
        z = course * HEIGHT
        for left, right in zip(ends, ends[1:]):
            box = boxes.add((left, 0, z), (right, THICKNESS, z + HEIGHT),
                            fixed=course == 0)
            for end in (0.0, LENGTH):
                if course and end in (left, right):
                    for y in (0, THICKNESS):
                        for height in (z, z + HEIGHT):
                            boxes.hold(box, (end, y, height), 1)
    return boxes


def write(name, header, values):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write(header + "\n" + ",".join("%.6g" % v for v in values)
                     + "\n")


def main():
    mu = np.tan(np.radians(FRICTION_ANGLE))
    within, around = (SpaceLimitAnalysis(panel(), mu, (0, 1, 0),
                                         around=around).associative()
                      for around in (False, True))
    print("pyramids within and around the cone: %.5f, %.5f" % (within, around))
    write("reference.csv", "within the cone [-],around the cone [-]",
          (within, around))
    blocks = RigidBlocksOnSprings(panel(), mu, (0, 1, 0), STIFFNESS, STIFFNESS,
                                  WEIGHT)
    loads = []
    for speed in (4e-9, 2e-9):
        factors = blocks.push(speed, 2e-4)[1]
        loads.append(np.mean(factors[-len(factors) // 10:]))
    load = 2 * loads[1] - loads[0]
    print("no dilation: %.5f and %.5f with drag, %.5f without"
          % (*loads, load))
    write("reference_no_dilation.csv", "time [s],factor [-]", (2, load))


if __name__ == "__main__":
    main()
