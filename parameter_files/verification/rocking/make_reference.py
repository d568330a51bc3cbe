#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Quarter periods of a rigid block that rocks about its corner.

From rest at the tilt theta0 to the impact at theta = 0. With p^2 = 3 g/(4 R),
alpha the angle of slenderness and theta'' = -p^2 sin(alpha - theta),

    theta'^2 = 2 p^2 (cos(alpha - theta0) - cos(alpha - theta)),

and the quarter is the integral of dtheta/|theta'|, which theta =
theta0 (1 - u^2) rids of its singularity. Housner (1963) has it for a slender
block, sin(alpha - theta) = alpha - theta, in closed form.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
B, H, G = 0.5, 2.0, 9.81           # half width, half height
ALPHA, R = np.arctan(B / H), np.hypot(B, H)
P2 = 3 * G / (4 * R)


def exact_quarter(ratio):
    theta0, n = ratio * ALPHA, 100000
    u = (np.arange(n) + 0.5) / n
    theta = theta0 * (1 - u**2)
    # of cos(alpha - theta0) - cos(alpha - theta), without cancellation
    rate = np.sqrt(4 * P2 * np.sin(ALPHA - (theta0 + theta) / 2)
                   * np.sin((theta0 - theta) / 2))
    return np.mean(2 * theta0 * u / rate)


def housner_quarter(ratio):
    return np.arccosh(1 / (1 - ratio)) / np.sqrt(P2)


if __name__ == "__main__":
    rows = [(r, np.degrees(r * ALPHA), exact_quarter(r), housner_quarter(r))
            for r in (0.1, 0.3, 0.5, 0.8)]
    np.savetxt(os.path.join(HERE, "quarters.csv"), rows, delimiter=",",
               fmt="%.9g", comments="", header="tilt / slenderness [-],tilt "
               "[deg],exact [s],Housner [s]")
    for row in rows:
        print("%.1f %8.4f deg  exact %.6f s  Housner %.6f s" % row)
    print("rate after / before an impact %.5f, energy %.5f"
          % (1 - 1.5 * np.sin(ALPHA)**2, (1 - 1.5 * np.sin(ALPHA)**2)**2))
