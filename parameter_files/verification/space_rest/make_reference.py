#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A stress with six components, linear in z, that balances a body force:
sxz' + rho gx = syz' + rho gy = szz' + rho gz = 0 with the gradients by z."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
# xx, yy, zz, xy, xz, yz
STRESS = np.array([-3e4, -2e4, -5e4, 3e3, -4e3, 2e3])
GRADIENT = np.array([1e4, 5e3, 2e4, 2e3, 3e3, -4e3])
DENSITY, YOUNG, POISSON = 2500.0, 20e9, 0.25
GRAVITY = -GRADIENT[[4, 5, 2]] / DENSITY


def stress(places):
    """Stress at points [Pa]."""
    return STRESS + np.multiply.outer(places[:, 2], GRADIENT)


def settlement():
    """Of the top of the box, 0.6 m high, under its weight on its base [m]."""
    modulus = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
    return DENSITY * abs(GRAVITY[2]) * 0.6**2 / (2 * modulus)


def main():
    base = -STRESS[[4, 5, 2]] * 0.8  # on 1 m x 0.8 m at z = 0
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("time [s],rx [N],ry [N],rz [N]\n0.01,%.9g,%.9g,%.9g\n"
                     % tuple(base))
    print("gravity", GRAVITY)


if __name__ == "__main__":
    main()
