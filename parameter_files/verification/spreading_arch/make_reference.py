#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Thrust of a flat arch of two rigid blocks on spreading supports."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LENGTH, HEIGHT, DENSITY, GRAVITY = 2.0, 1.0, 2000.0, 9.81
DIAGONAL = np.hypot(LENGTH, HEIGHT)
# the hinges are in one line
COLLAPSE = 2 * (DIAGONAL - LENGTH)


def rise(spread):
    """Rise of the hinge at the crown above those at the supports [m]."""
    return np.sqrt(DIAGONAL**2 - (LENGTH + spread / 2)**2)


def thrust(spread):
    """Moments of a block about its support [N]."""
    weight = DENSITY * GRAVITY * LENGTH * HEIGHT
    return weight * (LENGTH + spread / 2) / (2 * rise(spread))


def main():
    spread = np.linspace(0.02, 0.46, 221)
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([spread, thrust(spread), rise(spread) - HEIGHT]),
               fmt="%.6g", delimiter=",", comments="",
               header="spread [m],thrust [N],crown [m]")
    print("collapse at %.4f m" % COLLAPSE)


if __name__ == "__main__":
    main()
