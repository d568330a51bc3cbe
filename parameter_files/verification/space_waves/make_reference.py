#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A pulse f(t - z/c) that runs up a column and does not come back."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, E, NU = 2500.0, 25e9, 0.25
SHEAR = E / (2 * (1 + NU))
LAME = 2 * SHEAR * NU / (1 - 2 * NU)


def pulse(t, duration):
    return np.where((t > 0) & (t < duration),
                    0.5e-3 * (1 - np.cos(2 * np.pi * t / duration)), 0)


for name, modulus, duration, end in (("p", LAME + 2 * SHEAR, 2e-3, 0.01),
                                     ("s", SHEAR, 4e-3, 0.015)):
    speed = (modulus / RHO) ** 0.5
    times = np.arange(0, end, 5e-5)
    np.savetxt(os.path.join(HERE, "reference_%s.csv" % name),
               np.transpose([times] + [pulse(times - z / speed, duration)
                                       for z in (0, 10, 20)]),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],base [m/s],middle [m/s],top [m/s]")
