#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A rigid block on springs: equilibrium of forces and of moments."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, KS, LENGTH, WIDTH, HEIGHT = 1e9, 0.4e9, 2.0, 1.0, 0.5
FORCE, MOMENT = np.array([100.0, -60.0, -200.0]), np.array([10.0, 40.0, -30.0])
N = 8  # edges along the length; half as many along the width

area = LENGTH * WIDTH
# Of the areas of the joint's nodes, by the trapezoidal rule.
about_x = LENGTH * WIDTH**3 / 12 * (1 + 2 / (N / 2)**2)
about_y = WIDTH * LENGTH**3 / 12 * (1 + 2 / N**2)
arm = HEIGHT / 2  # of the centre above the joint
turn = np.array([(MOMENT[0] - arm * FORCE[1]) / (KN * about_x),
                 (MOMENT[1] + arm * FORCE[0]) / (KN * about_y),
                 MOMENT[2] / (KS * (about_x + about_y))])
moved = np.array([FORCE[0] / (KS * area) + turn[1] * arm,
                  FORCE[1] / (KS * area) - turn[0] * arm,
                  FORCE[2] / (KN * area)])
# The base, whose centre is half a height below the joint, holds all.
held = -(MOMENT + np.cross([0.0, 0.0, HEIGHT], FORCE))
values = dict(zip(
    ("ux [m]", "uy [m]", "uz [m]", "rx [deg]", "ry [deg]", "rz [deg]",
     "fx [N]", "fy [N]", "fz [N]", "mx [N m]", "my [N m]", "mz [N m]"),
    (*moved, *np.degrees(turn), *-FORCE, *held)))
np.savetxt(os.path.join(HERE, "reference.csv"), [[0.0, *values.values()]],
           delimiter=",", fmt="%.12g", comments="",
           header=",".join(["time [s]", *values]))

# Its foot instead: moments about the origin.
held = -(MOMENT + np.cross([LENGTH / 2, WIDTH / 2, 1.5 * HEIGHT], FORCE))
values = dict(zip(
    ("fx [N]", "fy [N]", "fz [N]", "mx [N m]", "my [N m]", "mz [N m]"),
    (*-FORCE, *held)))
np.savetxt(os.path.join(HERE, "reference_held.csv"), [[0.0, *values.values()]],
           delimiter=",", fmt="%.12g", comments="",
           header=",".join(["time [s]", *values]))

# A bar whose clamp turns at a constant rate, when it has turned by |TURN|: the cap
# at its other end follows, without force. The way of a corner of the cap against
# that of one of the clamp, which is ACROSS from it.
TURN, ACROSS = np.radians([80.0, 40.0, -60.0]), np.array([1.0, 1.0, 4.0])
angle = np.linalg.norm(TURN)
x, y, z = TURN / angle
skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
rotation = (np.eye(3) + np.sin(angle) * skew
            + (1 - np.cos(angle)) * skew @ skew)
values = dict(zip(
    ("ux [m]", "uy [m]", "uz [m]", "rx [deg]", "ry [deg]", "rz [deg]",
     "mx [N m]", "my [N m]", "mz [N m]"),
    (*(rotation @ ACROSS - ACROSS), *np.degrees(TURN), 0.0, 0.0, 0.0)))
np.savetxt(os.path.join(HERE, "reference_turning.csv"),
           [[1.0, *values.values()]], delimiter=",", fmt="%.12g", comments="",
           header=",".join(["time [s]", *values]))
