#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Slide of the rigid wedge along the line in which its joints meet: with the
normal forces R_A n_A + R_B n_B - T l = W z (Hoek & Bray 1974) the acceleration is
(T - (R_A + R_B) tan(phi))/m."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
JOINTS = [(40.0, 130.0), (60.0, 220.0)]  # dip, dip direction [deg]
FRICTION, GRAVITY, DURATION = np.radians(30), 9.81, 0.6


def normal(dip, direction):
    """Upward unit normal; x east, y north."""
    dip, direction = np.radians([dip, direction])
    return np.array([np.sin(dip) * np.sin(direction),
                     np.sin(dip) * np.cos(direction), np.cos(dip)])


def main():
    a, b = (normal(*joint) for joint in JOINTS)
    down = np.cross(a, b)
    down /= np.linalg.norm(down) * -np.sign(down[2])
    ra, rb, t = np.linalg.solve(np.transpose([a, b, -down]), [0, 0, 1])
    acceleration = GRAVITY * (t - (ra + rb) * np.tan(FRICTION))
    print("R_A/W %.4f, R_B/W %.4f, T/W %.4f, %.4f m/s^2"
          % (ra, rb, t, acceleration))
    x, y, z = 0.5 * acceleration * DURATION**2 * down
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("time [s],x [m],y [m],z [m]\n0.6,%.6f,%.6f,%.6f\n"
                     % (x, y, z))


if __name__ == "__main__":
    main()
