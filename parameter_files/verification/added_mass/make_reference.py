#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""References by rigid bodies and Westergaard's mass: see README.md."""
import math
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, G, CONCRETE = 1000.0, 9.81, 2400.0


def write(name, head, rows):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write(head + "\n")
        for row in rows:
            stream.write(",".join("%.12g" % value for value in row) + "\n")


def wall():
    """Forces of the water and of the base of a rigid wall whose base moves."""
    mass = CONCRETE * 12.0 * (6.0 + 4.0) / 2
    normal = np.array([-12.0, 2.0]) / math.hypot(12.0, 2.0)
    # 7/8 rho sqrt(H) times the integral of sqrt(z) is 7/12 rho H^2
    left = (7 / 12 * RHO * 10.0**2 / abs(normal[0])
            * np.outer(normal, normal))
    right = 7 / 12 * RHO * 8.0**2 * np.array([[1.0, 0.0], [0.0, 0.0]])
    rows = []
    for k in range(1, 50):
        t = k * 0.02
        a = np.array([
            0.1 * 4 * 2 * math.pi * math.sin(2 * math.pi * t)**3
            * math.cos(2 * math.pi * t),
            0.1 * 4 * math.pi * math.sin(math.pi * t)**3
            * math.cos(math.pi * t)])
        rise = 0.1 * (3 * t / 8 - math.sin(2 * math.pi * t) / (4 * math.pi)
                      + math.sin(4 * math.pi * t) / (32 * math.pi))
        static = -0.5 * RHO * G * (
            (10.0 - rise)**2 / abs(normal[0]) * normal
            + (8.0 - rise)**2 * np.array([1.0, 0.0]))
        base = (mass * np.eye(2) + left + right) @ a - static
        rows.append((0.2 + t, *(-left @ a), (-right @ a)[0], *base))
    write("wall.csv", "time [s],left_x [N],left_y [N],right_x [N],"
          "base_x [N],base_y [N]", rows)


def block(width=4.0, height=12.0, level=10.0, kn=5e8, ks=2e8, faces=8):
    """Motion of a rigid block on the springs of its joint, from its modes;
    unknowns: motion of the middle of its foot and rotation."""
    mass = CONCRETE * width * height
    inertia = mass * (width**2 + height**2) / 12 + mass * height**2 / 4
    matrix = np.array([[mass, 0, -mass * height / 2], [0, mass, 0],
                       [-mass * height / 2, 0, inertia]])
    # Water: the face moves by u - y theta.
    s, weights = np.polynomial.legendre.leggauss(20)
    root = 0.5 * math.sqrt(level) * (1 + s)         # sqrt of the depth
    water = (7 / 8 * RHO * math.sqrt(level) * root * 2 * root
             * 0.5 * math.sqrt(level) * weights)
    load = np.zeros(3)
    for m, r, w in zip(water, root, weights):
        y = level - r * r
        row = np.array([1.0, 0.0, -y])
        matrix += m * np.outer(row, row)
        load += (RHO * G * r * r * 2 * r * 0.5 * math.sqrt(level) * w) * row
    stiffness = np.zeros((3, 3))
    for i in range(faces + 1):
        length = width / faces * (0.5 if i in (0, faces) else 1.0)
        x = -width / 2 + i * width / faces
        stiffness += length * ks * np.outer([1, 0, 0], [1, 0, 0])
        stiffness += length * kn * np.outer([0, 1, x], [0, 1, x])
    chol = np.linalg.cholesky(matrix)
    inverse = np.linalg.inv(chol)
    squares, modes = np.linalg.eigh(inverse @ stiffness @ inverse.T)
    modes = inverse.T @ modes
    print("frequencies [Hz]", np.sqrt(squares) / (2 * math.pi))
    rows = []
    for k in range(1, 41):
        t = k * 0.02
        q = modes @ ((1 - np.cos(np.sqrt(squares) * t)) / squares
                     * (modes.T @ load))
        u, v, theta = q
        rows.append((t, u - height * theta, v - width / 2 * theta))
    write("block.csv", "time [s],top_x [m],top_y [m]", rows)


if __name__ == "__main__":
    wall()
    block()
