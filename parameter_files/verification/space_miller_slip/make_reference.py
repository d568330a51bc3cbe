#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The clipped wave of ../miller_slip along its polarisation.

The upper side lags behind the lower one at the rate 2 (f - g), f being the
velocity of the incident wave at the joint and g what it passes of it, and by the
elastic slip.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, G, TAU, COHESION, KS = 2650.0, 10e9, 1e6, 0.5e6, 10e9
C = (G / RHO) ** 0.5
Z = RHO * C
LIMIT = COHESION / Z
JOINT = 100.0


def incident(t):
    return np.where(t > 0, TAU / Z * np.sin(2 * np.pi * t), 0.0)


def passed(t):
    return np.clip(incident(t), -LIMIT, LIMIT)


times = np.arange(0, 2.2, 0.005)
below = (incident(times - 50 / C) + incident(times - 150 / C)
         - passed(times - 150 / C))
above = passed(times - 150 / C)
fine = np.arange(0, 2.2, 1e-5)
rate = 2 * (incident(fine - JOINT / C) - passed(fine - JOINT / C))
slip = -np.interp(times, fine, np.cumsum(rate) * 1e-5)
traction = Z * passed(times - JOINT / C)
slip -= traction / KS

for angle in (30, 75):
    x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    np.savetxt(os.path.join(HERE, "reference_%d.csv" % angle),
               np.transpose([times, x * below, y * below, x * above, y * above,
                             x * slip, y * slip, np.abs(traction)]),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],vx_below [m/s],vy_below [m/s],vx_above [m/s],"
               "vy_above [m/s],slip_x [m],slip_y [m],traction [Pa]")
