#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Free flight with spin: a parabola and a steady rotation."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
V, RATE, GRAVITY = (1.0, 2.0), np.radians(90.0), 9.81
CORNER = np.array([0.5, 0.25])

times = np.arange(0, 1 + 1e-9, 0.01)
x = V[0] * times
y = V[1] * times - GRAVITY * times**2 / 2
c, s = np.cos(RATE * times), np.sin(RATE * times)
corner_x = x + c * CORNER[0] - s * CORNER[1] - CORNER[0]
corner_y = y + s * CORNER[0] + c * CORNER[1] - CORNER[1]

np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, x, y, corner_x, corner_y]), delimiter=",",
           fmt="%.9g", comments="",
           header="time [s],x [m],y [m],corner_x [m],corner_y [m]")
