#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Hooke's law, in plane strain, of u = (2 x + y, y - 3 x) 1e-8."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU = 20e9, 0.25
XX, YY, XY = 2e-8, 1e-8, 0.5 * (1e-8 - 3e-8)
LAME = E * NU / ((1 + NU) * (1 - 2 * NU))
MU = E / (2 * (1 + NU))
X, Y = 1.0, 1.0
values = [1.0, LAME * (XX + YY) + 2 * MU * XX, LAME * (XX + YY) + 2 * MU * YY,
          2 * MU * XY, 1e-8 * (2 * X + Y), 1e-8 * (Y - 3 * X)]
np.savetxt(os.path.join(HERE, "reference.csv"), [values], delimiter=",",
           fmt="%.12g", comments="",
           header="time [s],sxx [Pa],syy [Pa],sxy [Pa],ux [m],uy [m]")
