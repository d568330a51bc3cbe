#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Stress in layered ground by its weight (Jaeger, Cook & Zimmerman 2007, 13.2):

  s_yy = -(p + sum of gamma dy),  s_xx = K0 s_yy + s_h,  s_zz = K_z s_yy,  s_xy = 0

on a joint whose normal makes the angle t with the vertical
s_yy cos^2 t + s_xx sin^2 t. Nothing moves.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
PRESSURE, RATIO, LOCKED_IN, OUT_OF_PLANE = 50e3, 0.5, -20e3, 0.4
BORDER, SOIL, ROCK = -6.0, 18e3, 26e3
FAULT = np.arctan((14 - 9.632357) / 12)


def stresses(y):
    """xx, yy, xy, zz [Pa] at the heights y [m]."""
    vertical = -(PRESSURE - SOIL * np.maximum(y, BORDER)
                 - ROCK * np.minimum(y - BORDER, 0))
    return np.stack([RATIO * vertical + LOCKED_IN, vertical, 0 * vertical,
                     OUT_OF_PLANE * vertical], axis=-1)


def normal_tractions(y):
    """Normal tractions of a horizontal joint, the fault and a vertical joint
    [Pa]."""
    horizontal, vertical = stresses(y)[:, 0], stresses(y)[:, 1]
    return np.stack([vertical, vertical * np.cos(FAULT)**2
                     + horizontal * np.sin(FAULT)**2, horizontal], axis=-1)


def settlement():
    """Settlement of the soil by its own weight, if it were loaded now [m]."""
    young, nu = 1e8, 0.3
    modulus = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    return SOIL * BORDER**2 / (2 * modulus)


def main():
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("time [s],settlement [m],traction [Pa]\n")
        # the joint point nearest to x = 6 m is found by the check
        stream.write("0,0,%.9g\n0.1,0,%.9g\n"
                     % ((normal_tractions(np.array([-11.816]))[0, 1],) * 2))


if __name__ == "__main__":
    main()
