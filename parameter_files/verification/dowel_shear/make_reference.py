#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A dowel k, elastic up to its strength S, moved 2 mm forth and 3 mm back: the
motion of the lower block relative to the upper one, along the bar to its left,
is minus that of the upper block. Three bars 4 m apart in a thickness of 2 m."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
STIFFNESS, STRENGTH = 50e6, 60e3
BARS = 3 * 2 / 4

times = np.arange(0, 2.001, 0.01)
u = 1e-3 * (1 - np.cos(np.pi * times)) - np.where(
    times < 1, 0, 0.5e-3 * (1 + np.cos(np.pi * times)))
force = np.zeros_like(u)
for i in range(1, len(u)):
    force[i] = np.clip(force[i - 1] + STIFFNESS * (u[i] - u[i - 1]),
                       -STRENGTH, STRENGTH)
np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, -u, -force, BARS * force]),
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],motion [m],dowel [N],reaction [N]")
