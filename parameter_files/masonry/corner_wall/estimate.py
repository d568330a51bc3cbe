#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The weight of the corner [N], and accelerations by gravity at which parts of
it overturn about the front edge of the facade: the facade alone, and with a
wedge of the return above a crack that climbs from the foot of the corner along
the joints, half a unit back in each course. The corner is as strong as the
first at least, and no stronger than the second.
"""
import numpy as np

LENGTH, RETURN, HEIGHT, THICKNESS = 1.44, 0.96, 0.8, 0.12
UNIT, COURSE = 0.24, 0.08
WINDOW, SILL, HEAD = 0.48, 3 * COURSE, 7 * COURSE
DENSITY, GRAVITY = 2000, 9.81


def facade():
    """Area in plan by height, and its lever about the edge."""
    z = (np.arange(8000) + 0.5) * HEIGHT / 8000
    length = LENGTH - WINDOW * ((SILL < z) & (z < HEAD))
    return z, length * THICKNESS, np.full(z.shape, THICKNESS / 2)


def wedge():
    z = (np.arange(8000) + 0.5) * HEIGHT / 8000
    depth = np.minimum(RETURN - THICKNESS, z * UNIT / 2 / COURSE)
    return z, depth * THICKNESS, THICKNESS + depth / 2


def acceleration(parts):
    z, area, lever = np.hstack(parts)
    return float(np.sum(area * lever) / np.sum(area * z))


def weight():
    plan = (LENGTH + RETURN - THICKNESS) * THICKNESS
    window = WINDOW * THICKNESS * (HEAD - SILL)
    return DENSITY * GRAVITY * (plan * HEIGHT - window)


if __name__ == "__main__":
    print("weight %.5f N, acceleration between %.3f g and %.3f g"
          % (weight(), acceleration([facade()]),
             acceleration([facade(), wedge()])))
