#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacements and stresses under a square with a uniform pressure.

Love's closed form for the corner of a rectangle of four: settlement of the
surface and vertical stress. The rest by Boussinesq's point load, integrated over
the square by Gauss's rule.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, PRESSURE, HALF = 20e9, 0.25, 1e6, 1.0
G = E / (2 * (1 + NU))


def point_load(x, y, z):
    """u_x, u_z along z upwards, s_xx and s_zz of a unit load at the origin, at
    the depth z."""
    R = np.sqrt(x * x + y * y + z * z)
    a = 1 - 2 * NU
    ux = (x * z / R**3 - a * x / (R * (R + z))) / (4 * np.pi * G)
    uz = -(z * z / R**3 + 2 * (1 - NU) / R) / (4 * np.pi * G)
    sxx = -(3 * x * x * z / R**5 - a * (
        z / R**3 - 1 / (R * (R + z)) + x * x * (2 * R + z) / (R**3 * (R + z)**2)
    )) / (2 * np.pi)
    szz = -3 * z**3 / R**5 / (2 * np.pi)
    return np.array([ux, uz, sxx, szz])


def integrated(x, y, z, n=400):
    """The same under the pressure on the square."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    X, Y = np.meshgrid(HALF * nodes, HALF * nodes)
    w = PRESSURE * HALF**2 * np.outer(weights, weights)
    return np.sum(point_load(x - X, y - Y, z) * w, axis=(1, 2))


def corner_settlement(a, b):
    """Of a rectangle's corner."""
    d = np.hypot(a, b)
    return PRESSURE * (1 - NU**2) / (np.pi * E) * (
        a * np.log((b + d) / a) + b * np.log((a + d) / b))


def corner_stress(a, b, z):
    """s_zz at the depth z under a rectangle's corner."""
    R = np.sqrt(a * a + b * b + z * z)
    return -PRESSURE / (2 * np.pi) * (
        np.arctan(a * b / (z * R))
        + a * b * z / R * (1 / (a * a + z * z) + 1 / (b * b + z * z)))


def main():
    centre = -4 * corner_settlement(HALF, HALF)
    corner = -corner_settlement(2 * HALF, 2 * HALF)
    # 2 m from the centre: two rectangles to the far edge less two to the near
    beside = -2 * (corner_settlement(3 * HALF, HALF)
                   - corner_settlement(HALF, HALF))
    for depth in (0.5, 1.0):
        assert np.isclose(4 * corner_stress(HALF, HALF, depth),
                          integrated(0, 0, depth)[3])
    assert np.isclose(beside, integrated(2.0, 0, 0)[1], rtol=1e-4)
    values = {
        "centre [m]": centre, "corner [m]": corner,
        "deep [m]": integrated(0, 0, 1.0)[1],
        "deeper [m]": integrated(0, 0, 2.0)[1], "beside [m]": beside,
        "szz_1 [Pa]": 4 * corner_stress(HALF, HALF, 0.5),
        "szz_2 [Pa]": 4 * corner_stress(HALF, HALF, 1.0),
        "sxx_1 [Pa]": integrated(0, 0, 0.5)[2]}
    # what a point load gets wrong at the sides of the box
    places = [(6, y, z) for y in (0, 3, 6) for z in (0, 3, 6)]
    places += [(x, y, 6) for x in (0, 3, 6) for y in (0, 3, 6)]
    worst = max(np.max(np.abs(
        integrated(*p)[:2] - 4 * HALF**2 * PRESSURE * point_load(*p)[:2]))
        for p in places)
    print("displacements of the sides to %.1e of the settlement"
          % (worst / abs(centre)))
    np.savetxt(os.path.join(HERE, "reference.csv"), [[0.0, *values.values()]],
               delimiter=",", fmt="%.9g", comments="",
               header=",".join(["time [s]", *values]))


if __name__ == "__main__":
    main()
