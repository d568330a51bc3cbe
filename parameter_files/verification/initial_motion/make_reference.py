#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A pulse in a strip with free ends, by d'Alembert.

u = f(x - c t) to the right, and images beyond the free ends: the strip goes on
with even reflections of the pulse about x = 0 and x = L.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
L, C, AMPLITUDE, CENTRE, WIDTH = 20.0, 3000.0, 1e-4, 7.0, 2.0


def pulse(x):
    return AMPLITUDE * np.exp(-((x - CENTRE) / WIDTH)**2)


def displacement(x, t):
    u = np.zeros_like(t)
    for n in range(-2, 3):
        # to the right from CENTRE + 2 n L, and its image about x = 0
        u += pulse(x - C * t - 2 * n * L) + pulse(-x - C * t - 2 * n * L)
    return u


times = np.arange(0, 0.0133, 1e-4)
np.savetxt(os.path.join(HERE, "reference.csv"),
           np.transpose([times] + [displacement(x, times)
                                   for x in (0.0, 10.0, 20.0)]),
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],start [m],middle [m],end [m]")
