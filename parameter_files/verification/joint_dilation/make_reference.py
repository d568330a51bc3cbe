#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""One dilating Coulomb joint in direct shear under constant normal stress.

The joint opens by u_n = (u_s - u_slip) tan psi between the first slip and the
critical shear displacement and not beyond it; the shear traction stays at
c + |s| tan phi.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, KS, STRESS, CRITICAL = 10e9, 5e9, 1e6, 2e-3
PEAK = 0.5e6 + STRESS * np.tan(np.radians(30))
FIRST = PEAK / KS

times = np.arange(0, 0.9, 2e-3)
pressed = np.where(times < 0.1, (1 - np.cos(np.pi * times / 0.1)) / 2, 1.0)
normal = -STRESS * pressed
slip = 5e-3 * np.maximum(times - 0.1, 0)
shear = np.minimum(KS * slip, PEAK)
dilation = (np.clip(slip, FIRST, CRITICAL) - FIRST) * np.tan(np.radians(10))

np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, slip, normal / KN + dilation, normal, shear]),
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],slip [m],opening [m],normal [Pa],shear [Pa]")
