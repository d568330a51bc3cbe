#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes shear.csv, compression.csv and dilation.csv: a square of Mohr-Coulomb
ground in plane strain at large strains, in closed form. See README.md."""
import os

import numpy as np

YOUNG, POISSON = 1e8, 0.3
COHESION = 1e5
DURATION = 40.0
FOLDER = os.path.dirname(os.path.abspath(__file__))


def number(angle):
    sine = np.sin(np.radians(angle))
    return (1 + sine) / (1 - sine)


def share(t):
    """Of the motion that is prescribed."""
    return 0.5 * (1 - np.cos(np.pi * t / DURATION))


def shear(t):
    modulus = YOUNG / (2 * (1 + POISSON))
    slip = share(t)
    force = np.minimum(modulus * slip, COHESION)
    return {"slip [m]": slip, "shear [N]": force, "normal [N]": 0 * t,
            "stress_xy [Pa]": force}


def compression(t, friction=0.0, dilation=0.0):
    strength = 2 * COHESION * np.sqrt(number(friction))
    height = 1 - 0.5 * share(t)
    shortening = -np.log(height)
    # logarithmic strains of the Kirchhoff stress -q J along y, plane strain
    along = (1 - POISSON**2) * strength / YOUNG
    across = POISSON * (1 + POISSON) * strength / YOUNG
    elastic = np.minimum(shortening / along, 1)
    width = np.ones_like(t)
    for _ in range(20):
        volume = width * height
        flow = np.maximum(shortening - along * volume, 0)
        width = np.exp(across * elastic * volume + number(dilation) * flow)
    stress = -strength * elastic
    return {"settlement [m]": height - 1, "widening [m]": width - 1,
            "above [m]": width - 1, "force [N]": stress * width,
            "stress_yy [Pa]": stress}


def write(name, t, columns):
    np.savetxt(os.path.join(FOLDER, name), np.column_stack(
        [t, *columns.values()]), fmt="%.12g", delimiter=",",
               header=",".join(["time [s]", *columns]), comments="")


if __name__ == "__main__":
    times = np.linspace(0, DURATION, 81)
    write("shear.csv", times, shear(times))
    write("compression.csv", times, compression(times))
    write("dilation.csv", times, compression(times, 30, 10))
