#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Velocities after the impacts: conservation of momentum and, of the velocity
at which blocks part, the coefficient of restitution.

Each line is a column of histories.csv: what its block has after the impact.
"""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
V0, ALONG, FRICTION = -1.0, 1.5, math.tan(math.radians(10))


def pair(name, e, above=1.0, below=1.0):
    """Velocities after V0 of the mass above meets the mass below at rest."""
    change = (1 + e) * V0 / (above + below)
    return [(name, V0 - below * change), (name + "_below", above * change)]


def rows():
    result = [("wall_02", -0.2 * V0), ("wall_05", -0.5 * V0),
              ("wall_08", -0.8 * V0), ("wall_10", -V0),
              ("wall_soft_05", -0.5 * V0)]
    # friction of the whole pressure while it slides
    result += [("slides", -0.5 * V0),
               ("slides_along", ALONG + FRICTION * 1.5 * V0)]
    # kn = ks and the same damping: both velocities turn alike
    result += [("sticks", -0.5 * V0), ("sticks_along", -0.5 * ALONG)]
    result += pair("equal_02", 0.2) + pair("equal_05", 0.5)
    result += pair("equal_08", 0.8) + pair("equal_10", 1.0)
    result += pair("soft_05", 0.5) + pair("soft_02", 0.2)
    result += pair("light_02", 0.2, below=4) + pair("light_08", 0.8, below=4)
    result += pair("small_05", 0.5, above=0.16)
    return result


if __name__ == "__main__":
    with open(os.path.join(HERE, "velocities.csv"), "w") as out:
        out.write("column,velocity [m/s]\n")
        for name, velocity in rows():
            out.write("%s,%.10g\n" % (name, velocity))
