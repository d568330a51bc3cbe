#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The factor of the axle at which no line of thrust is left inside the arch.

Static theorem of limit analysis (Heyman 1966): thrust, shear and moment of the
left springing and the factor are the unknowns of a linear program; at each joint
the resultant stays within the thickness and within friction. The numbers are
those of arch.geo and case.prm. Needs scipy (python3-scipy).
"""
import os

import numpy as np
from scipy.optimize import linprog

SPAN, RISE, THICKNESS, VOUSSOIRS = 4.0, 1.0, 0.30, 19
FIRST, LAST = 5, 7                       # voussoirs below the axle
DENSITY, FRICTION = 2200 * 9.81, np.tan(np.radians(35))
FILL, LEVEL = 18e3, 1.6                  # unit weight [N/m^3], its surface [m]
AXLE = 100e3 / 2.5                       # [N] for each metre of the width


def loads():
    """Joints (two ends each) and, for each voussoir, its weight with the fill
    and the axle as (force downwards, its moment about the origin)."""
    inside = (SPAN**2 / 4 + RISE**2) / (2 * RISE)
    outside, centre = inside + THICKNESS, RISE - inside
    half = np.arcsin(SPAN / 2 / inside)
    angle = half * np.linspace(-1, 1, VOUSSOIRS + 1)
    unit = np.stack([np.sin(angle), np.cos(angle)], axis=1)
    lower, upper = ([0, centre] + r * unit for r in (inside, outside))
    dead, live = [], []
    points, weights = np.polynomial.legendre.leggauss(4)
    for k in range(VOUSSOIRS):
        corners = np.array([lower[k], lower[k + 1], upper[k + 1], upper[k]])
        x, y = corners.T
        cross = x * np.roll(y, -1) - np.roll(x, -1) * y
        own = abs(cross.sum()) / 2 * DENSITY
        force = [own, own * ((x + np.roll(x, -1)) * cross).sum()
                 / (3 * cross.sum())]
        a, b = upper[k], upper[k + 1]
        for s, w in zip((points + 1) / 2, weights / 2):
            px, py = a + s * (b - a)
            p = FILL * (LEVEL - py) * (py - centre) / outside
            p *= w * np.hypot(*(b - a))
            force[0] += p
            force[1] += p * px
        dead.append(force)
        share = AXLE / (LAST - FIRST + 1) if FIRST <= k + 1 <= LAST else 0
        live.append([share, share * (a + b)[0] / 2])
    return lower, upper, np.array(dead), np.array(live)


def collapse_factor():
    lower, upper, dead, live = loads()
    middle = (lower + upper) / 2
    rows, limits = [], []
    for j, (low, up) in enumerate(zip(lower, upper)):
        across = (up - low) / THICKNESS
        along = np.array([across[1], -across[0]])       # to the right
        # force of what is on the left and its moment about the joint's middle:
        # columns horizontal and vertical force, moment, factor, constant
        horizontal = np.array([1.0, 0, 0, 0, 0])
        vertical = np.array([0, 1.0, 0, -live[:j, 0].sum(),
                             -dead[:j, 0].sum()])
        x, y = middle[0] - middle[j]
        moment = np.array([
            -y, x, 1.0,
            -(live[:j, 1] - middle[j, 0] * live[:j, 0]).sum(),
            -(dead[:j, 1] - middle[j, 0] * dead[:j, 0]).sum()])
        normal = along[0] * horizontal + along[1] * vertical
        shear = across[0] * horizontal + across[1] * vertical
        for sign in (-1, 1):
            for row in (sign * moment - normal * THICKNESS / 2,
                        sign * shear - normal * FRICTION):
                rows.append(row[:4])
                limits.append(-row[4])
    done = linprog([0, 0, 0, -1], A_ub=np.array(rows), b_ub=limits,
                   bounds=[(None, None)] * 3 + [(0, None)], method="highs")
    if done.status != 0:
        raise RuntimeError(done.message)
    return done.x[3], done.x[0]


def main():
    factor, thrust = collapse_factor()
    print("factor %.4f, axle %.0f kN, horizontal thrust %.1f kN/m"
          % (factor, factor * 100, thrust / 1e3))


if __name__ == "__main__":
    main()
