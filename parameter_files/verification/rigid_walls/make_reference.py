#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Collapse loads of the two walls by limit analysis; see README.md.

Needs scipy (Debian's python3-scipy).
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE)]
from limit_analysis import Blocks, LimitAnalysis  # noqa: E402
from make_geometry import WALLS, courses, rectangle  # noqa: E402

FRICTION = 0.65


def assemble(number):
    blocks, below, joints = Blocks(), None, 0
    for course in courses(number):
        row = [(brick, blocks.add_block(rectangle(*brick)))
               for brick in course]
        for (a, i), (_, j) in zip(row, row[1:]):
            blocks.add_joint(i, j, [(a[1], a[2]), (a[1], a[3])], (1, 0))
            joints += 1
        for (left, right, bottom, _), i in row:
            for (a, b, _, _), j in below or [((left, right, 0, 0), -1)]:
                ends = max(a, left), min(b, right)
                if ends[1] - ends[0] > 1e-9:
                    blocks.add_joint(j, i, [(x, bottom) for x in ends],
                                     (0, 1))
                    joints += 1
        below = row
    return blocks, joints


def main():
    names, loads = [], []
    for name, number in WALLS.items():
        blocks, joints = assemble(number)
        analysis = LimitAnalysis(blocks, FRICTION)
        upper = analysis.associative()
        found = [analysis.no_dilation(seed) for seed in range(5)]
        lower = min(load for load, gap in found if gap < 1e-9)
        print("%s: %d blocks, %d joints, associative %.5f, no dilation %.5f "
              "(from %s)" % (name, len(blocks.weights), joints, upper, lower,
                             ", ".join("%.5f" % load for load, _ in found)))
        names += [name + " associative [-]", name + " no dilation [-]"]
        loads += [upper, lower]
    np.savetxt(os.path.join(HERE, "reference.csv"), [loads], fmt="%.5f",
               delimiter=",", comments="", header=",".join(names))


if __name__ == "__main__":
    main()
