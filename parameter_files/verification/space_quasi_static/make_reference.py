#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A column with free sides on an inclined joint, shortened and lengthened slowly.

The stress p along the column gives the joint, whose normal dips by the angle a, the
tractions p cos^2 a and p sin a cos a, which it bears up to
cohesion + p cos^2 a tan phi. With the elastic shortening of column and joint

  e = p (L/E + cos^3 a/kn + sin^2 a cos a/ks)

the rest of the shortening is sin a times what has slipped down the dip. Poisson's
ratio is 0, so that a base that is held disturbs nothing.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, LENGTH, KN, KS, COHESION = 20e9, 3.0, 40e9, 20e9, 0.2e6
FRICTION, DIP, TO = np.radians([30.0, 50.0, 30.0])
S, C = np.sin(DIP), np.cos(DIP)
COMPLIANCE = LENGTH / E + C**3 / KN + S**2 * C / KS
LARGEST = COHESION / (S * C - C**2 * np.tan(FRICTION))


def shortening(t):
    return np.where(t < 0.01, 2e-2 * t, 2e-4 - 1.6e-2 * (t - 0.01))


def main():
    times = np.linspace(0, 0.015, 61)
    stress, slipped, rows = 0.0, 0.0, []
    for t in times:
        w = shortening(t)
        stress = min((w - S * slipped) / COMPLIANCE, LARGEST)
        slipped = (w - stress * COMPLIANCE) / S     # never back: stress > 0
        slip = slipped + stress * S * C / KS
        closure = stress * C**2 / KN
        out = slip * C - closure * S                # along the dip's direction
        rows.append([t, -w, stress, out * np.cos(TO), out * np.sin(TO),
                     slip * C * np.cos(TO), slip * C * np.sin(TO), -slip * S,
                     -stress * C**2, stress * S * C])
    print("the joint bears %.6g MPa along the column" % (LARGEST / 1e6))
    np.savetxt(os.path.join(HERE, "reference.csv"), rows, delimiter=",",
               fmt="%.9g", comments="",
               header="time [s],down [m],force [N],u_x [m],u_y [m],slip_x [m],"
               "slip_y [m],slip_z [m],normal [Pa],shear [Pa]")


if __name__ == "__main__":
    main()
