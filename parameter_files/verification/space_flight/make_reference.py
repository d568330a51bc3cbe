#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Free flight of a rigid cuboid: a parabola and Euler's equations of motion."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
SIDES = np.array([1.0, 0.8, 0.6])
VELOCITY, SPIN = np.array([1.0, 0.5, 4.0]), np.array([1.0, 2.0, 0.5])
GRAVITY = np.array([0.0, 0.0, -9.81])
# of the mass, about the axes of the block
INERTIA = (np.sum(SIDES**2) - SIDES**2) / 12


def rate(state):
    """d/dt of the rotation and of the spin in the axes of the block."""
    turned, w = state[:9].reshape(3, 3), state[9:]
    across = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    return np.concatenate(((turned @ across).ravel(),
                           -np.cross(w, INERTIA * w) / INERTIA))


times = np.arange(0, 1 + 1e-9, 0.01)
state = np.concatenate((np.eye(3).ravel(), SPIN))
rotations = [np.eye(3)]
N = 20
for step in np.repeat(np.diff(times) / N, N):
    k1 = rate(state)
    k2 = rate(state + step / 2 * k1)
    k3 = rate(state + step / 2 * k2)
    k4 = rate(state + step * k3)
    state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    rotations.append(state[:9].reshape(3, 3))

flight = np.outer(times, VELOCITY) + np.outer(times**2 / 2, GRAVITY)
corner = SIDES / 2
spin = np.array([r @ corner - corner for r in rotations[::N]])
np.savetxt(os.path.join(HERE, "reference.csv"),
           np.column_stack([times, flight, flight + spin]), delimiter=",",
           fmt="%.9g", comments="",
           header="time [s],x [m],y [m],z [m],"
           "corner_x [m],corner_y [m],corner_z [m]")
