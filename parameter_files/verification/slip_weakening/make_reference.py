#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A slip-weakening joint sheared back and forth under constant pressure.

Between two turns of the slip s the shear traction is ks (s - p) or, with the
direction d of slip and D = D0 + d (s - tau/ks - p), the strength peak - w D,
w = (peak - residual)/Dc, no less than the residual one. D never falls.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, KS, STRESS, CRITICAL = 10e9, 5e9, 1e6, 3e-3
PEAK = 0.5e6 + STRESS * np.tan(np.radians(35))
RESIDUAL = 0.1e6 + STRESS * np.tan(np.radians(20))
W = (PEAK - RESIDUAL) / CRITICAL
# times in the stage at which slip turns, and slips there
TURNS = [(0.0, 0.0), (0.24, 1.2e-3), (0.66, -0.9e-3), (1.2, 1.8e-3)]


def traction(slip, direction, plastic, slipped):
    """The law from a turn on, solved for the traction."""
    way = slipped + direction * (slip - plastic)
    falling = (PEAK - W * way) / (1 - W / KS)
    strength = np.maximum(falling, RESIDUAL)
    return direction * np.minimum(direction * KS * (slip - plastic), strength)


times = np.arange(0, 1.3, 2e-3)
pressed = np.where(times < 0.1, (1 - np.cos(np.pi * times / 0.1)) / 2, 1.0)
t = np.maximum(times - 0.1, 0)
slip = np.interp(t, *np.transpose(TURNS))
shear = np.zeros_like(slip)
plastic = slipped = 0.0
for (start, first), (end, last) in zip(TURNS[:-1], TURNS[1:]):
    leg = (t >= start) & (t <= end + 1e-9)
    direction = np.sign(last - first)
    shear[leg] = traction(slip[leg], direction, plastic, slipped)
    left = last - traction(last, direction, plastic, slipped) / KS
    slipped += abs(left - plastic)
    plastic = left

np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, slip, -STRESS * pressed / KN,
                         -STRESS * pressed, shear]),
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],slip [m],opening [m],normal [Pa],shear [Pa]")
