#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Surface of a layer, or of a soft layer on it, over a half-space.

A pulse f comes up from the base at depth H: the free surface moves with
2 f(t - H/c). With a soft layer of depth h on top, what crosses into it,
T = 2 z/(z + z_s), z = rho c, is doubled at the surface and goes to and fro with
R = (z_s - z)/(z_s + z) at its foot: 2 T sum R^n f(t - t_1 - 2 n h/c_s).
The S pulse is 30 degrees off x, the P pulse half as large. A base that moves as
f reflects what comes down: 2 sum (-1)^n f(t - (2 n + 1) H/c).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
H, SOIL = 20.0, 8.0
NAMES = ("corner", "side", "near", "middle")
times = np.arange(0, 0.08, 5e-4)


def pulse(t):
    a = (np.pi * 50 * (t - 0.03))**2
    return 0.01 * (1 - 2 * a) * np.exp(-a)


def surface(speed, soil_speed, rho=2500.0, soil_rho=2500.0):
    z, zs = rho * speed, soil_rho * soil_speed
    through, back = 2 * z / (z + zs), (zs - z) / (zs + z)
    arrival = (H - SOIL) / speed + SOIL / soil_speed
    return sum(2 * through * back**n
               * pulse(times - arrival - 2 * n * SOIL / soil_speed)
               for n in range(60))


def write(name, s_wave, p_wave):
    parts = (np.sqrt(0.75) * s_wave, 0.5 * s_wave, 0.5 * p_wave)
    columns = [times] + [part for _ in NAMES for part in parts]
    np.savetxt(os.path.join(HERE, name), np.transpose(columns), delimiter=",",
               fmt="%.9g", comments="", header=",".join(
                   ["time [s]"] + ["%s_%s [m/s]" % (n, a)
                                   for n in NAMES for a in "xyz"]))


CS = (18.75e9 / (2 * 2500 * 1.25))**0.5
write("reference.csv", surface(CS, CS), surface(CS * 3**0.5, CS * 3**0.5))
# soil: 5 GPa, nu 0.25, 2000 kg/m^3
SOIL_CS = (5e9 / (2 * 2000 * 1.25))**0.5
write("reference_layers.csv", surface(CS, SOIL_CS, soil_rho=2000.0),
      surface(CS * 3**0.5, SOIL_CS * 3**0.5, soil_rho=2000.0))


def driven(speed):
    return sum(2 * (-1)**n * pulse(times - (2 * n + 1) * H / speed)
               for n in range(20))


write("reference_driven.csv", driven(CS), driven(CS * 3**0.5))
