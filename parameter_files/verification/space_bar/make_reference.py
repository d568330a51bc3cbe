#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Bar of tetrahedra fixed at x = 0 under a step load at x = L, by d'Alembert.

The end velocity p/z is carried by the waves to and fro: the displacement is
the sum of ramps p/z (t - arrival), alternating in sign with every reflection
at the fixed end.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
L, E, RHO, LOAD = 10.0, 40e9, 2500.0, 1e6
C = (E / RHO) ** 0.5


def displacement(x, t):
    u = np.zeros_like(t)
    for n in range(20):
        sign = (-1) ** n
        # leaves the end at 2 n L / c, returns from the fixed end negative
        u += sign * np.maximum(C * t - (2 * n + 1) * L + x, 0)
        u -= sign * np.maximum(C * t - (2 * n + 1) * L - x, 0)
    return LOAD / E * u


times = np.arange(0, 0.02, 1e-4)
np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times, displacement(L, times),
                         displacement(L / 2, times)]),
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],end [m],middle [m]")
