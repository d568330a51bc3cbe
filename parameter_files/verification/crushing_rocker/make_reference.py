#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A rigid stone pressed by N on a rigid floor rocks about its toe.

The section is cut into fibres without tension, the points of the stone's lower
face at the distance s from the toe. Turned by phi, with the toe at the height
y, they have closed by v = -(y + s sin(phi)) and act on the floor over
ds cos(phi). A fibre that closes for the first time follows the curve of the cap
of Lourenco and Rots (1997), v = p/kn + kappa with p = cap(kappa), where kappa is
what it has closed for good; otherwise p = kn (v - kappa), not below zero. The
height y follows from the sum of forces for each phi, by bisection with the
fibres' histories of the step before.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, FM, GFC, KP = 1e10, 5e6, 2e4, 2e-3
N, B, HALF_HEIGHT = 0.3e6, 1.0, 0.05
FIBRES, STEPS = 1000, 500


def cap(kappa):
    first, middle, last = FM / 3, FM / 2, FM / 7
    km = 75 / 67 * GFC / FM + KP
    x = np.minimum(kappa / KP, 1)
    rising = first + (FM - first) * np.sqrt(x * (2 - x))
    falling = FM + (middle - FM) * ((kappa - KP) / (km - KP))**2
    slope = 2 * (middle - FM) / (km - KP)
    tail = last + (middle - last) * np.exp(slope * (np.maximum(kappa, km) - km)
                                           / (middle - last))
    return np.where(kappa < KP, rising, np.where(kappa < km, falling, tail))


# dense where the curve begins, with an upright tangent
KAPPA = 0.1 * np.linspace(0, 1, 20001)**3
CLOSED = cap(KAPPA) / KN + KAPPA


def pressure(v, most):
    """Pressure of fibres closed by v whose largest closure so far was most."""
    kappa = np.interp(np.maximum(v, most), CLOSED, KAPPA)
    return np.maximum(KN * (v - kappa), 0)


def main():
    s = (np.arange(FIBRES) + 0.5) / FIBRES * B
    most = np.zeros(FIBRES)
    rows = []
    for t in np.linspace(0, 1, STEPS + 1):
        phi = 0.05 * t**2
        ds = B / FIBRES * np.cos(phi)
        low, high = -0.1, 0.0
        for _ in range(45):
            y = (low + high) / 2
            force = pressure(-y - s * np.sin(phi), most).sum() * ds
            low, high = (y, high) if force > N else (low, y)
        v = -y - s * np.sin(phi)
        p = pressure(v, most)
        most = np.maximum(most, v)
        arm = (B / 2 - s) * np.cos(phi) - HALF_HEIGHT * np.sin(phi)
        closing = (y + N / (KN * B) + B / 2 * np.sin(phi)
                   + HALF_HEIGHT * (np.cos(phi) - 1))
        rows.append((0.1 + t, -(p * arm).sum() * ds, closing))
    np.savetxt(os.path.join(HERE, "reference.csv"), rows[::5], delimiter=",",
               fmt="%.8g", comments="",
               header="time [s],moment [N m],closing [m]")


if __name__ == "__main__":
    main()
