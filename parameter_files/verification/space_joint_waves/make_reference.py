#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A plane pulse through one linear joint.

With the velocity f of the incident wave at the joint, g of the transmitted one
and z = rho c both sides carry the stress -z g, and the joint closes by 2 (f - g)
in a unit of time, so that g' = (2 k / z) (f - g). f - g goes back.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, E, NU = 2500.0, 25e9, 0.25
SHEAR = E / (2 * (1 + NU))
LAME = 2 * SHEAR * NU / (1 - 2 * NU)
DT = 1e-6


def pulse(t, duration):
    return np.where((t > 0) & (t < duration),
                    0.5e-3 * (1 - np.cos(2 * np.pi * t / duration)), 0)


for name, modulus, k, duration, end, own in (
        ("p", LAME + 2 * SHEAR, 10e9, 2e-3, 0.01, "opening"),
        ("s", SHEAR, 3e9, 4e-3, 0.015, "slip_y")):
    speed = (modulus / RHO) ** 0.5
    z = RHO * speed
    fine = np.arange(0, end, DT)
    # Exact for f linear within a step.
    rate = 2 * k / z
    decay = np.exp(-rate * DT)
    last = 1 - (1 - decay) / (rate * DT)
    f = pulse(fine - 10 / speed, duration)
    g = np.zeros_like(f)
    for i in range(1, len(f)):
        g[i] = (decay * g[i - 1] + (1 - decay - last) * f[i - 1] + last * f[i])
    times = np.arange(0, end, 5e-5)

    def late(values, distance):
        return np.interp(times - distance / speed, fine, values, left=0)

    at_joint = late(g, 0)
    traction = -z * at_joint if name == "p" else z * np.abs(at_joint)
    np.savetxt(os.path.join(HERE, "reference_%s.csv" % name),
               np.transpose([times,
                             pulse(times - 5 / speed, duration)
                             + late(f - g, 5),
                             late(g, 5), -z / k * at_joint, traction]),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],below [m/s],above [m/s],%s [m],traction [Pa]"
               % own)
