#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Limit equilibrium of two columns, the upper of which topples onto the lower.

With the tangent t of the friction that is left: the upper column presses on the
lower one with the force by which it stays on its lower edge; this slides when the
force and its weight reach the friction of its foot, which bears the friction of
its side, too.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DIP, FRICTION = np.radians(16), np.tan(np.radians(40))
HIGH, LOW, WIDTH = 4.0, 2.0, 1.0  # m; forces by rho g per m

# Moments about the lower edge of the upper column, the force at LOW.
force = (HIGH * WIDTH / 2
         * (HIGH * np.sin(DIP) - WIDTH * np.cos(DIP)) / LOW)
weight = LOW * WIDTH
# weight sin + force = t (weight cos + force t)
t = ((-weight * np.cos(DIP)
      + np.sqrt((weight * np.cos(DIP))**2
                + 4 * force * (weight * np.sin(DIP) + force))) / (2 * force))
# The lower column does not topple: moments about its lower edge.
assert (weight / 2 * (LOW * np.sin(DIP) - WIDTH * np.cos(DIP))
        + force * (LOW - t * WIDTH)) < 0

with open(os.path.join(HERE, "reference.csv"), "w") as table:
    table.write("columns [-]\n%.6g\n" % (FRICTION / t))
