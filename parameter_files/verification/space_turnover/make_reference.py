#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A rigid body that spins about its middle axis, by Euler's equations.

The masses of tetrahedra are lumped at their corners, which makes moments of inertia of a
coarse mesh larger; of_masses() has those of a mesh, so that what is compared is the
motion alone.
"""
import numpy as np

SIDES = np.array([1.0, 0.8, 0.6])
SPIN = np.array([0.4, 9.8, 0.2])
DENSITY = 2000.0
# two corners, between which is an end of the middle axis
CORNERS = np.array([[0.5, 0.4, 0.3], [-0.5, 0.4, -0.3]])


def of_masses(x, mass):
    return (np.sum(mass * np.sum(x**2, axis=1)) * np.eye(3)
            - np.einsum("p,pi,pj->ij", mass, x, x))


def homogeneous():
    return (DENSITY * np.prod(SIDES) / 12
            * np.diag(np.sum(SIDES**2) - SIDES**2))


def rate(state, inertia, inverse):
    turned, w = state[:9].reshape(3, 3), state[9:]
    across = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    return np.concatenate(((turned @ across).ravel(),
                           -inverse @ np.cross(w, inertia @ w)))


def rotations(inertia, times, substeps=4):
    """Rotation matrices of the body at the times, from SPIN at time 0 on."""
    inverse = np.linalg.inv(inertia)
    state = np.concatenate((np.eye(3).ravel(), SPIN))
    found, now = [], 0.0
    for time in times:
        h = (time - now) / substeps
        for _ in range(substeps if h > 0 else 0):
            k1 = rate(state, inertia, inverse)
            k2 = rate(state + h / 2 * k1, inertia, inverse)
            k3 = rate(state + h / 2 * k2, inertia, inverse)
            k4 = rate(state + h * k3, inertia, inverse)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        now = time
        found.append(state[:9].reshape(3, 3))
    w = state[9:]
    # momentum and energy are those of the start
    assert np.allclose(found[-1] @ inertia @ w, inertia @ SPIN, rtol=1e-5,
                       atol=1e-5 * np.max(inertia @ SPIN))
    assert abs(w @ inertia @ w / (SPIN @ inertia @ SPIN) - 1) < 1e-6
    return np.array(found)


def turnovers(axis, inertia, times):
    """Times at which the middle axis, a direction at each of the times, is across
    the angular momentum."""
    along = axis @ (inertia @ SPIN)
    at = np.flatnonzero(along[1:] * along[:-1] < 0)
    return times[at] + (times[at + 1] - times[at]) * along[at] / (
        along[at] - along[at + 1])


if __name__ == "__main__":
    t = np.arange(0, 10.001, 5e-3)
    print("a homogeneous cuboid turns over at",
          turnovers(rotations(homogeneous(), t)[:, :, 1], homogeneous(), t))
