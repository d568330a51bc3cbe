#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""References of a floating block: see README.md."""
import math
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, G, DENSITY = 1000.0, 9.81, 600.0
WIDTH, HEIGHT, DRAFT = 4.0, 2.0, 1.2


def write(name, head, rows):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write(head + "\n")
        for row in rows:
            stream.write(",".join("%.12g" % value for value in row) + "\n")


def below_water(points):
    """Area and centroid of the part of a polygon below y = 0."""
    kept = []
    for p, q in zip(points, np.roll(points, -1, axis=0)):
        if p[1] <= 0:
            kept.append(p)
        if (p[1] <= 0) != (q[1] <= 0):
            kept.append(p + (q - p) * p[1] / (p[1] - q[1]))
    x, y = np.array(kept).T
    u, v = np.roll(x, -1), np.roll(y, -1)
    cross = x * v - u * y
    area = cross.sum() / 2
    return area, np.array([((x + u) * cross).sum(),
                           ((y + v) * cross).sum()]) / (6 * area)


CENTRE = np.array([0.0, HEIGHT / 2 - DRAFT])
CORNERS = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (
    WIDTH / 2, HEIGHT / 2)


def turned(angle):
    c, s = math.cos(angle), math.sin(angle)
    return CORNERS @ np.array([[c, s], [-s, c]])


def rate(state):
    """Archimedes: the weight of the water goes up through its centroid."""
    centre, angle = CENTRE + state[:2], state[2]
    area, at = below_water(centre + turned(angle))
    mass = DENSITY * WIDTH * HEIGHT
    inertia = mass * (WIDTH**2 + HEIGHT**2) / 12
    lift = RHO * G * area
    return np.array([*state[3:], 0.0, lift / mass - G,
                     lift * (at[0] - centre[0]) / inertia])


def main():
    state, rows, n, step = np.array([0, 0, 0, 0, 0.5, 0.3]), [], 50, 0.001
    for k in range(1, 121):
        for _ in range(n):
            a = rate(state)
            b = rate(state + step / 2 * a)
            c = rate(state + step / 2 * b)
            d = rate(state + step * c)
            state = state + step / 6 * (a + 2 * b + 2 * c + d)
        moved = state[:2] + turned(state[2]) - CORNERS
        rows.append((k * n * step, moved[3][1], moved[2][1], moved[2][0]))
    write("reference.csv", "time [s],left [m],right [m],drift [m]", rows)
    write("soft_foot.csv", "time [s],sinks [m]",
          [(t, -(DENSITY * G * 1.0 - RHO * G * 0.4 * t) / (2e4 + RHO * G))
           for t in (0.25, 0.5, 0.75, 1.0)])
    write("soft_foot_end.csv", "time [s],sinks [m]",
          [(1.0, -(DENSITY * G * 1.0 - RHO * G * 0.4) / (2e4 + RHO * G))])


if __name__ == "__main__":
    main()
