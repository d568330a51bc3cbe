#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The largest factor of an axle for which a line of thrust lies in the arch.

Static theorem of limit analysis (Heyman 1966): voussoirs of any strength are safe
as long as some forces on their joints are in balance with the loads, press, stay
within the thickness and within friction. Unknowns of the linear program are the
two normal forces at the ends of each joint, its shear force and the factor; three
equations of each voussoir tie them. The numbers of main() are those of case.prm.
Needs scipy (python3-scipy).
"""
import sys

import numpy as np
from scipy.optimize import linprog


def joints(span, rise, ring, voussoirs):
    """Lower and upper ends of the radial joints, (n + 1, 2) each [m]."""
    radius = (span**2 / 4 + rise**2) / (2 * rise)
    half = 2 * np.arctan2(2 * rise, span)
    angle = half * np.linspace(-1, 1, voussoirs + 1)
    ray = np.stack([np.sin(angle), np.cos(angle)], axis=1)
    centre = np.array([0, rise - radius])
    return centre + radius * ray, centre + (radius + ring) * ray


def weights(lower, upper, unit_weight):
    """Weights of the voussoirs, as (force downwards [N/m], its place x
    [m])."""
    found = []
    for k in range(len(lower) - 1):
        x, y = np.array([lower[k], lower[k + 1], upper[k + 1], upper[k]]).T
        cross = x * np.roll(y, -1) - np.roll(x, -1) * y
        found.append([abs(cross.sum()) / 2 * unit_weight,
                      ((x + np.roll(x, -1)) * cross).sum()
                      / (3 * cross.sum())])
    return np.array(found)


def largest_factor(lower, upper, dead, live, friction, push=None):
    """The factor of the live loads, and the joints, counted from 0 at the left,
    where the thrust is at an end or on the edge of friction.

    @p dead and @p live are (force downwards, its place x) of each voussoir,
    @p push the least and the most that fill pushes horizontally towards the
    middle on the middle of its extrados [N/m].
    """
    n = len(lower)
    push = np.zeros((n - 1, 2)) if push is None else push
    matrix, right = np.zeros((3 * n - 3, 4 * n)), []

    def add(row, joint, sign, place):
        """The forces of a joint on the voussoir right (1) or left (-1) of it."""
        across = upper[joint] - lower[joint]
        across = across / np.hypot(*across)
        along = np.array([across[1], -across[0]])       # to the right
        for column, at, force in ((0, lower[joint], along),
                                  (1, upper[joint], along),
                                  (2, lower[joint], across)):
            arm = at - place
            matrix[row:row + 3, 3 * joint + column] += sign * np.array(
                [force[0], force[1], arm[0] * force[1] - arm[1] * force[0]])

    for k in range(n - 1):
        place = (lower[k] + upper[k + 1]) / 2
        add(3 * k, k, 1, place)
        add(3 * k, k + 1, -1, place)
        right += [0, dead[k][0], dead[k][0] * (dead[k][1] - place[0])]
        matrix[3 * k + 1:3 * k + 3, 3 * n] = [
            -live[k][0], -live[k][0] * (live[k][1] - place[0])]
        middle = (upper[k] + upper[k + 1]) / 2
        inwards = -np.sign(round(middle[0], 9))
        matrix[[3 * k, 3 * k + 2], 3 * n + 1 + k] = [
            inwards, -inwards * (middle - place)[1]]
    limits = np.zeros((2 * n, 4 * n))
    for j in range(n):
        limits[2 * j, 3 * j:3 * j + 3] = [-friction, -friction, 1]
        limits[2 * j + 1, 3 * j:3 * j + 3] = [-friction, -friction, -1]
    bounds = ([(0, None), (0, None), (None, None)] * n + [(0, None)]
              + [tuple(p) for p in push])
    cost = np.zeros(4 * n)
    cost[3 * n] = -1
    done = linprog(cost, A_ub=limits, b_ub=np.zeros(2 * n), A_eq=matrix,
                   b_eq=right, bounds=bounds, method="highs")
    if done.status != 0:
        sys.exit("no line of thrust: " + done.message)
    forces = done.x[:3 * n].reshape(n, 3)
    normal = forces[:, :2].sum(axis=1)
    hinges = np.flatnonzero(forces[:, :2].min(axis=1) < 1e-6 * normal)
    slides = np.flatnonzero(abs(forces[:, 2]) > (1 - 1e-6) * friction * normal)
    return done.x[3 * n], list(map(int, hinges)), list(map(int, slides))


def main():
    lower, upper = joints(4.0, 1.0, 0.3, 15)
    live = np.zeros((15, 2))
    live[4] = [10e3, (upper[4] + upper[5])[0] / 2]      # voussoir 5
    factor, hinges, slides = largest_factor(
        lower, upper, weights(lower, upper, 2200 * 9.81), live,
        np.tan(np.radians(35)))
    print("factor %.5f: %.2f kN for each metre; hinges at joints %s, slip at %s"
          % (factor, factor * 10, hinges, slides))


if __name__ == "__main__":
    main()
