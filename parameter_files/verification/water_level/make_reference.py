#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Forces of the base of a wall of 6 m beside water of the depth h: half of
gamma h^2 at a third of the depth; above 6 m a rectangle comes to it."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
GAMMA, HEIGHT = 9810.0, 6.0


def row(t, level):
    below, above = min(level, HEIGHT), max(level - HEIGHT, 0.0)
    force = GAMMA * (below**2 / 2 + above * below)
    moment = GAMMA * (below**3 / 6 + above * below**2 / 2)
    # anticlockwise about the origin; the water turns the wall clockwise
    return t, -force, 0.0, moment


def write(name, rows):
    np.savetxt(os.path.join(HERE, name), rows, delimiter=",", fmt="%.12g",
               comments="",
               header="time [s],force [N],lift [N],moment [N m]")


write("reference.csv", [row(t, 0.7 + 6 * t) for t in np.arange(21) * 0.05])
write("explicit.csv", [row(1.0, 4.3)])
