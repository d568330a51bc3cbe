#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Settlement of an elastic half-plane under a step of pressure on a strip.

Lamb's problem in closed form gives the velocity of the surface at a distance s
from a line load F H(t): pi mu s v_z / F is a function V of y = t/s alone. The
displacement under a strip is its integral over time and over the width of the
strip; both are taken beforehand, which leaves one integral over y. The means
over the elements at which the histories are taken add one more integration.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DENSITY, YOUNG, POISSON = 2000.0, 5e6, 0.25
PRESSURE, HALF_WIDTH = 1000.0, 1.0
ELEMENT = HALF_WIDTH / 8
MU = YOUNG / (2 * (1 + POISSON))
C2 = (MU / DENSITY) ** 0.5
C1 = C2 * (2 * (1 - POISSON) / (1 - 2 * POISSON)) ** 0.5

# in units of half width, c2 and mu
Q1 = (C2 / C1) ** 2


def velocity(y):
    """V for 1/c1 < y, z downwards as the load."""
    a = np.sqrt(y**2 - Q1)
    b = np.sqrt(np.abs(y**2 - 1))
    d = 1 - 2 * y**2
    before = -a * d**2 / (d**4 + 16 * y**4 * a**2 * b**2)
    with np.errstate(divide="ignore"):
        after = -a / (d**2 - 4 * y**2 * a * b)
    return np.where(y < 1, before, after)


def rayleigh():
    """1/c_R, where V has its pole."""
    low, high = 1.0, 2.0
    for _ in range(200):
        y = (low + high) / 2
        value = (1 - 2 * y**2)**2 - 4 * y**2 * np.sqrt((y**2 - Q1)
                                                       * (y**2 - 1))
        low, high = (y, high) if value > 0 else (low, y)
    return y


POINTS, WEIGHTS = np.polynomial.legendre.leggauss(60)
POLE = rayleigh()
# the principal value over this interval about the pole
RADIUS = 0.5 * (POLE - 1)


def nodes(low, high):
    """Points and weights that take roots at both ends."""
    angle = np.pi / 4 * (POINTS + 1)
    y = low + (high - low) * np.sin(angle)**2
    return y, np.pi / 4 * WEIGHTS * (high - low) * 2 * np.sin(angle) * np.cos(
        angle)


def integral(weight, breaks):
    """PV of the integral of V(y) weight(y) from 1/c1 to infinity.

    weight falls as 1/y and has kinks at the breaks.
    """
    far = 1e3 * max(10.0, *breaks)
    cuts = sorted({Q1**0.5, 1.0, POLE - RADIUS, POLE, POLE + RADIUS, far,
                   *(10.0**k for k in (0.5, 1, 1.5, 2, 3, 4) if 10.0**k < far),
                   *(y for y in breaks if Q1**0.5 < y < far)})
    at_pole = weight(np.array([POLE]))[0]
    total = 0.0
    for low, high in zip(cuts[:-1], cuts[1:]):
        y, w = nodes(low, high)
        value = weight(y)
        if POLE - RADIUS <= low and high <= POLE + RADIUS:
            value = value - at_pole
        total += np.sum(w * velocity(y) * value)
    # what was taken away next to the pole, by pairs of points
    shift = RADIUS * (POINTS + 1) / 2
    pairs = velocity(POLE + shift) + velocity(POLE - shift)
    total += at_pole * np.sum(WEIGHTS * pairs) * RADIUS / 2
    # the rest, where V = 1/(2 (1 - Q1) y) and weight = weight(far) far/y
    total += weight(np.array([far]))[0] / (2 * (1 - Q1))
    return total


def integrated(distance, t):
    """The displacement beside a line load, integrated from 0 to a distance, and
    this once more over the distance."""
    s = abs(distance)
    if s == 0 or t <= 0:
        return 0.0
    return integral(
        lambda y: np.where(s < t / y, s**2 / 2, t / y * (s - t / y / 2)),
        [t / s]) / np.pi


def at_element(x, t, length):
    """The mean of mu u_z / (p b) over an element about x/b."""
    low, high = x - length / 2, x + length / 2
    return (integrated(high + 1, t) - integrated(low + 1, t)
            - integrated(high - 1, t) + integrated(low - 1, t)) / length


if __name__ == "__main__":
    half = ELEMENT / HALF_WIDTH / 2
    # times at which no wave of a strip edge ends at the end of an element
    times = np.arange(0.25, 10.01, 0.25)
    scale = -PRESSURE * HALF_WIDTH / MU
    columns = [scale * np.array([at_element(x, t, 2 * half) for t in times])
               for x in (half, 1 - half, 1 + half, 3 + half)]
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([times * HALF_WIDTH / C2] + columns),
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],middle [m],edge_inside [m],edge_outside [m],"
               "beside [m]")
