#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Motion of the surface above an explosive line source in a half-plane.

Garvin's problem by Cagniard's method: the response to a moment that is switched
on is a closed form, whose singular front is removed by t = T cosh(theta), T the
travelling time of the P wave. The integral over theta is its convolution with
the rate of the moment; histories are means over elements.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DENSITY, C1, C2 = 2000.0, 3e6**0.5, 1000.0
DEPTH, MOMENT, FREQUENCY, DELAY = 10.0, 1e8, 60.0, 0.025
ELEMENT = 120.6 / 201
Q1, Q2 = C1**-2, C2**-2
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(400)


def moment_rate(t):
    a = np.pi * FREQUENCY
    s = a * (t - DELAY)
    return MOMENT * a * 2 * s * (2 * s**2 - 3) * np.exp(-s**2)


def displacement(x, t):
    """u_x and u_y at x on the surface."""
    r = np.hypot(x, DEPTH)
    arrival = r / C1
    # the wavelet is nothing before t = 0
    if t <= arrival:
        return np.zeros(2)
    theta = np.arccosh(t / arrival) * (POINTS + 1) / 2
    weights = np.arccosh(t / arrival) / 2 * WEIGHTS
    # Cagniard's path, on which eta_1 h + i p x = t
    p = (-1j * x * np.cosh(theta) + DEPTH * np.sinh(theta)) * arrival / r**2
    eta1, eta2 = np.sqrt(Q1 + p**2), np.sqrt(Q2 + p**2)
    a = Q2 + 2 * p**2
    rayleigh = a**2 - 4 * p**2 * eta1 * eta2
    rate = weights * moment_rate(t - arrival * np.cosh(theta))
    factor = 2 * Q2 / (2 * np.pi * DENSITY * C1**2)
    return factor * np.array([
        np.sum(rate * np.real(2j * p * eta1 * eta2 / rayleigh)),
        np.sum(rate * np.real(a * eta1 / rayleigh))])


def mean(x, t):
    points, weights = np.polynomial.legendre.leggauss(4)
    return sum(w / 2 * displacement(x + ELEMENT / 2 * s, t)
               for s, w in zip(points, weights))


if __name__ == "__main__":
    times = np.arange(0, 0.068, 2e-4)
    above, near, far = (np.array([mean(x, t) for t in times])
                        for x in (0.0, 17 * ELEMENT, 34 * ELEMENT))
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.column_stack([times, above[:, 1], near, far]),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],above [m],near_x [m],near_y [m],far_x [m],"
               "far_y [m]")
