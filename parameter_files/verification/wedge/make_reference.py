#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Statics of a frictionless wedge between two fixed blocks; see README.md."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DENSITY, GRAVITY, STIFFNESS = 2500.0, 10.0, 1e9
HALF = np.radians(30)
TOP, LOW, HIGH, WIDTH, PEBBLE = 1.0, 0.2, 0.9, 2.0, 0.02

weight = DENSITY * GRAVITY * (TOP**2 * np.tan(HALF) + PEBBLE**2)
normal = weight / 2 / np.sin(HALF)
flank = (HIGH - LOW) * (WIDTH - np.tan(HALF) * (LOW + HIGH) / 2)
own = DENSITY * GRAVITY * flank
sink = normal / (STIFFNESS * (HIGH - LOW) / np.cos(HALF)) / np.sin(HALF)
row = [1.0, normal * np.cos(HALF), own + weight / 2,
       -normal * np.cos(HALF), own + weight / 2, -sink]
np.savetxt(os.path.join(HERE, "reference.csv"), [row], delimiter=",",
           fmt="%.10g", comments="",
           header="time [s],left_x [N],left_y [N],right_x [N],right_y [N],"
                  "sink [m]")
