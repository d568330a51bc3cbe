#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""One Coulomb joint in direct shear under constant normal stress.

Shear traction: slope ks to the peak c + |s| tan phi, then the residual one;
elastic on reversal, then the residual one the other way. No dilation.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, KS, STRESS = 10e9, 5e9, 1e6
PEAK = 0.5e6 + STRESS * np.tan(np.radians(30))
RESIDUAL = 0.1e6 + STRESS * np.tan(np.radians(25))
END, BACK = 4e-3, 2e-3

times = np.arange(0, 1.3, 2e-3)
pressed = np.where(times < 0.1, (1 - np.cos(np.pi * times / 0.1)) / 2, 1.0)
normal = -STRESS * pressed
t = np.maximum(times - 0.1, 0)
slip = np.where(t < 0.8, 5e-3 * t, END - 5e-3 * (t - 0.8))
forward = np.where(KS * slip <= PEAK, KS * slip, RESIDUAL)
backward = np.maximum(RESIDUAL - KS * (END - slip), -RESIDUAL)
shear = np.where(t < 0.8, forward, backward)

np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, slip, normal / KN, normal, shear]),
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],slip [m],opening [m],normal [Pa],shear [Pa]")
