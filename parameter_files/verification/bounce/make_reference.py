#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A rigid block that bounces on a linear spring: parabolas and half waves.

In contact, y < 0 the height of the foot, y = -g/w^2 + A cos(w t + psi) with
A cos psi = g/w^2 and w A sin psi = v0, the speed of touch-down; it leaves after
(2 pi - 2 psi)/w.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
G, HEIGHT, MASS, STIFFNESS = 10.0, 0.1, 4000.0, 4e6
W = (STIFFNESS / MASS) ** 0.5
V0 = (2 * G * HEIGHT) ** 0.5
PSI = np.arctan(W * V0 / G)
FALL, CONTACT = V0 / G, (2 * np.pi - 2 * PSI) / W
PERIOD = 2 * FALL + CONTACT


def height(t):
    """Height of the foot above the base [m]."""
    # time since the last apex or, below, since touch-down
    t = np.mod(t, PERIOD)
    flight = np.minimum(t, PERIOD - t)
    a = G / W**2 / np.cos(PSI)
    return np.where(flight < FALL, HEIGHT - G * flight**2 / 2,
                    -G / W**2 + a * np.cos(W * (t - FALL) + PSI))


if __name__ == "__main__":
    times = np.arange(0, 4.8 + 1e-9, 4e-3)
    y = height(times)
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([times, y - HEIGHT]),
               delimiter=",", fmt="%.12g", comments="", header="time [s],y [m]")
    # local damping of 0.8 leaves a fifth of the acceleration
    times = np.arange(0, 0.3 + 1e-9, 4e-3)
    np.savetxt(os.path.join(HERE, "local.csv"),
               np.transpose([times, -(1 - 0.8) * G * times**2 / 2]),
               delimiter=",", fmt="%.12g", comments="", header="time [s],y [m]")
    print("contact %.6f s, period %.6f s, deepest %.5f m, %.2f bounces, "
          "w %.4f /s" % (CONTACT, PERIOD, -height(np.array(PERIOD / 2)),
                         4.8 / PERIOD, W))
