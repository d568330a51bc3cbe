#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Static overturning of the column, and the published pulse amplitudes.

At a constant acceleration the part above some joint turns about that joint's
edge as soon as a/g exceeds half the joint's width by the height of the part's
centroid above it.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE]
from make_geometry import blocks  # noqa: E402

# overturning amplitude [g] for pulses of 0.2 s and 0.5 s
UDEC, LMGC90 = (1.46, 0.27), (1.48, 0.25)


def static():
    """Least a/g and the number of drums below the joint that opens."""
    area, moment, loads = 0.0, 0.0, []
    for a, b, bottom, top in reversed(blocks()):
        height = top - bottom
        own = (a + b) / 2 * height
        area += own
        moment += own * (bottom + height * (a + 2 * b) / (3 * (a + b)))
        loads.append(a / 2 / (moment / area - bottom))
    loads.reverse()
    return min(loads), int(np.argmin(loads))


def main():
    load, joint = static()
    print("static: %.4f g at the joint above %d drums" % (load, joint))
    row = [load, *(f(x) for x in zip(UDEC, LMGC90) for f in (min, max))]
    np.savetxt(os.path.join(HERE, "reference.csv"), [row], fmt="%.4f",
               delimiter=",", comments="",
               header="static [g],0.2 s low [g],0.2 s high [g],"
               "0.5 s low [g],0.5 s high [g]")


if __name__ == "__main__":
    main()
