#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A plane pulse through linear joints across its way, by characteristics.

Where a wave of the velocity a meets a joint from below and one of b from above,
its stress is s = k o with the opening o; with z = rho c the waves that leave it
have a + s/z downwards and b - s/z upwards, so that o' = 2 (b - a) - 2 s/z. They
travel unchanged between joints.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, E, NU = 2500.0, 25e9, 0.25
SHEAR = E / (2 * (1 + NU))
LAME = 2 * SHEAR * NU / (1 - 2 * NU)
KN, KS = 10e9, 3e9
BELOW, ABOVE = 1.5, 4.5


def pulse(t, duration):
    return np.where((t > 0) & (t < duration),
                    0.5e-3 * (1 - np.cos(2 * np.pi * t / duration)), 0)


def along_way(modulus, k, duration, end, joints):
    """Times and the velocities at BELOW and ABOVE."""
    speed = np.sqrt(modulus / RHO)
    z = RHO * speed
    dt = 0.5 / speed / 400            # joints are multiples of 0.5 m apart
    t = np.arange(0, end, dt)
    n = len(joints)
    up = np.zeros((n, len(t)))        # what leaves each joint, upwards
    down = np.zeros((n, len(t)))
    opening = np.zeros(n)
    decay = np.exp(-2 * k / z * dt)

    def late(values, distance, i):
        j = i - int(round(distance / speed / dt))
        return values[j] if j >= 0 else 0.0

    for i in range(1, len(t)):
        for m in range(n):
            a = (pulse(t[i] - joints[0] / speed, duration) if m == 0
                 else late(up[m - 1], joints[m] - joints[m - 1], i))
            b = 0.0 if m == n - 1 else late(down[m + 1],
                                            joints[m + 1] - joints[m], i)
            # exact for a and b constant in a step
            drive = z / k * (b - a)
            opening[m] = drive + decay * (opening[m] - drive)
            s = k * opening[m]
            down[m, i] = a + s / z
            up[m, i] = b - s / z
    back = np.interp(t - (joints[0] - BELOW) / speed, t, down[0], left=0)
    return (t, pulse(t - BELOW / speed, duration) + back,
            np.interp(t - (ABOVE - joints[-1]) / speed, t, up[-1], left=0))


def polarisations(d):
    """Of P, SV and SH waves."""
    across = np.cross([0, 0, 1.0], d)
    across /= np.linalg.norm(across)
    return d, np.cross(across, d), across


def main():
    first, second = np.array([.48, .6, .64]), np.array([-.36, .48, .8])
    one, three = [3.0], [2.5, 3.0, 3.5]
    for name, d, joints in (("one", first, one), ("three", second, three),
                            ("one_second", second, one),
                            ("three_first", first, three)):
        p, sv, sh = polarisations(d)
        for wave, modulus, k, duration, end, way in (
                ("p", LAME + 2 * SHEAR, KN, 2.4e-3, 3.65e-3, p),
                ("s", SHEAR, KS, 4e-3, 4.65e-3, 0.8 * sv + 0.6 * sh)):
            t, below, above = along_way(modulus, k, duration, end, joints)
            rows = np.column_stack([t, np.outer(below, way),
                                    np.outer(above, way)])[::20]
            np.savetxt(os.path.join(HERE, "reference_%s_%s.csv"
                                    % (name, wave)), rows, delimiter=",",
                       fmt="%.8g", comments="",
                       header="time [s],x_below [m/s],y_below [m/s],"
                       "z_below [m/s],x_above [m/s],y_above [m/s],"
                       "z_above [m/s]")


if __name__ == "__main__":
    main()
