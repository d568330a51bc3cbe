#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Limit equilibrium of a wedge on two planes.

R_A n_A + R_B n_B - T l = W z with the upward normals and the line of
intersection l, downwards; without cohesion it slides where T = (R_A + R_B) tan(phi),
with cohesion its factor of safety is (c A + (R_A + R_B) tan(phi)) / T with the area
A of both planes (Hoek & Bray 1974).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def normal(dip, direction):
    dip, direction = np.radians([dip, direction])
    return np.array([np.sin(dip) * np.sin(direction),
                     np.sin(dip) * np.cos(direction), np.cos(dip)])


a, b = normal(40, 130), normal(60, 220)
line = np.cross(a, b)
line *= -np.sign(line[2]) / np.linalg.norm(line)


def on_both(weight):
    """Friction angle [deg] and the normal forces, of a weight that is a vector.
    """
    on_a, on_b, along = np.linalg.solve(np.transpose([a, b, -line]), -weight)
    return np.degrees(np.arctan(along / (on_a + on_b))), on_a, on_b


def on_one(weight, plane):
    across = -weight @ plane
    return np.degrees(np.arctan(np.linalg.norm(weight + across * plane)
                                / across))


friction, on_a, on_b = on_both(np.array([0, 0, -1.0]))
# pushed off plane b, which would have to pull
PUSHED = np.array([-0.3, -0.35, -1.0])
assert on_both(PUSHED)[2] < 0
one = on_one(PUSHED, a)
np.savetxt(os.path.join(HERE, "reference.csv"), [[friction, on_a, on_b, one]],
           delimiter=",", fmt="%.6g", comments="",
           header="friction angle [deg],normal force on a [-],"
           "normal force on b [-],pushed off b [deg]")

# the wedge of wedge.geo: 2 m of the line and 1.5 m along the level of each plane
up = -2 * line
level_a = np.array([np.cos(np.radians(130)), -np.sin(np.radians(130)), 0])
level_b = np.array([np.cos(np.radians(220)), -np.sin(np.radians(220)), 0])
level_a *= 1.5 * np.sign(level_a @ b)
level_b *= 1.5 * np.sign(level_b @ a)
area = 0.5 * (np.linalg.norm(np.cross(up, level_a))
              + np.linalg.norm(np.cross(up, level_b)))
weight = (2600 * 9.81 / 6
          * abs(up @ np.cross(up + level_a, up + level_b)))


def factor(cohesion, degrees):
    _, on_a, on_b = on_both(np.array([0, 0, -1.0]))
    driving = np.tan(np.radians(friction)) * (on_a + on_b)
    return ((cohesion * area / weight
             + (on_a + on_b) * np.tan(np.radians(degrees))) / driving)


np.savetxt(os.path.join(HERE, "reference_safety.csv"),
           [[factor(2e3, 40), factor(0, 40)]], delimiter=",", fmt="%.6g",
           comments="", header="cohesive [-],frictional [-]")
