#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Axial strength of a specimen with an inclined Coulomb joint under the pressures
px and py on its sides.

The upper part is in equilibrium with the traction S n of the joint, S = diag(px, py,
s1): it slips where the shear traction is c + N tan(phi), a quadratic equation of s1,
and along that traction. With px = py = s3 this is Jaeger's (1960) formula,
whatever the dip direction.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
COHESION, FRICTION, END, AREA = 1e6, np.tan(np.radians(30)), 0.3, 1.0


def normal(dip, direction):
    dip, direction = np.radians([dip, direction])
    return np.array([np.sin(dip) * np.sin(direction),
                     np.sin(dip) * np.cos(direction), np.cos(dip)])


def excess(s1, px, py, n):
    """Shear traction above the strength."""
    traction = np.array([px, py, s1]) * n
    across = traction @ n
    return (np.linalg.norm(traction - across * n)
            - COHESION - FRICTION * across)


def strength(dip, direction, px, py):
    """Axial stress [Pa] at which the joint slips under an axial load that grows."""
    n = normal(dip, direction)
    low, high = max(px, py), 1e9
    assert excess(low, px, py, n) < 0 < excess(high, px, py, n)
    for _ in range(200):
        middle = (low + high) / 2
        low, high = ((low, middle) if excess(middle, px, py, n) > 0
                     else (middle, high))
    return low


def slip(dip, direction, px, py):
    """Direction in which the upper part slips."""
    n = normal(dip, direction)
    traction = -np.array([px, py, strength(dip, direction, px, py)]) * n
    shear = traction - traction @ n * n
    return shear / np.linalg.norm(shear)


def jaeger(dip, s3):
    b = np.radians(dip)
    return s3 + 2 * (COHESION + s3 * FRICTION) / (
        (1 - FRICTION / np.tan(b)) * np.sin(2 * b))


def write(name, *state):
    s1 = strength(*state)
    print("%s: %.3f MPa, slips along %s" % (name, s1 / 1e6,
                                            np.round(slip(*state), 4)))
    np.savetxt(os.path.join(HERE, "reference_%s.csv" % name),
               [[0, 0], [END, -AREA * s1]], delimiter=",", fmt="%.9g",
               comments="", header="time [s],force [N]")


def main():
    for dip in (40, 50, 60):
        for direction in (30, 75, 200):
            assert abs(strength(dip, direction, 2e6, 2e6)
                       / jaeger(dip, 2e6) - 1) < 1e-9
        # a stress along the strike does not count
        assert abs(strength(dip, 90, 2e6, 5e6) / jaeger(dip, 2e6) - 1) < 1e-9
        write("%d" % dip, dip, 30, 2e6, 2e6)
    write("intermediate", 50, 60, 2e6, 5e6)


if __name__ == "__main__":
    main()
