#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Bar fixed at x = 0 under a step load at x = L, by d'Alembert.

The displacement is a sum of ramps that leave the end 2 n L/c after the load and
come back from the fixed end with the other sign, for ever.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
L, HEIGHT, E, RHO, LOAD = 4.0, 1.0, 40e9, 2500.0, 1e6
C = (E / RHO) ** 0.5
PERIODS = 20


def displacement(x, t):
    """Displacement at x and the times t, within the first PERIODS periods."""
    u = np.zeros_like(t)
    for n in range(2 * PERIODS + 2):
        sign = (-1) ** n
        u += sign * np.maximum(C * t - (2 * n + 1) * L + x, 0)
        u -= sign * np.maximum(C * t - (2 * n + 1) * L - x, 0)
    return LOAD / E * u


def base_force(t):
    """Force of the support on the bar: 0 or twice the load, pulling back."""
    since = (C * t - L) % (4 * L)
    return np.where((C * t > L) & (since < 2 * L), -2 * LOAD * HEIGHT, 0)


if __name__ == "__main__":
    times = np.arange(0, 0.016001, 2e-4)
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([times, displacement(L, times),
                             displacement(1.9375, times)]),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],end [m],middle [m]")
