#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Pulses f that come up through rock below a free surface, at z = 0, of which it sends
back all: at z the velocity is

  f(t - (H + z)/c) + f(t - (H - z)/c),

f as it enters at the base, z = -H; and the settlement of the surface by the weight of
the rock between rollers, rho g H^2/(2 M), M = rho c_P^2.
"""
import numpy as np

H, RHO, GRAVITY, YOUNG, NU = 20.0, 2500.0, 9.81, 18.75e9, 0.25
MODULUS = YOUNG * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
SPEED = {"S": (YOUNG / (2 * (1 + NU) * RHO))**0.5, "P": (MODULUS / RHO)**0.5}
PEAK = {"x": 0.01 * 0.75**0.5, "y": 0.01 * 0.5, "z": 0.01 * 0.5}
BEGINS = 0.02
SETTLEMENT = RHO * GRAVITY * H**2 / (2 * MODULUS)


def pulse(t):
    a = (np.pi * 50 * (t - 0.055))**2
    return np.where(t < BEGINS, 0.0, (1 - 2 * a) * np.exp(-a))


def velocity(axis, z, t):
    """Component along the axis at the height z, at times since the base lets
    waves in [m/s]."""
    speed = SPEED["P" if axis == "z" else "S"]
    return PEAK[axis] * (pulse(t - (H + z) / speed)
                         + pulse(t - (H - z) / speed))


if __name__ == "__main__":
    print("settlement %.6g m, waves" % SETTLEMENT, SPEED)
