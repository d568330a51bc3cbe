#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Limit equilibrium of a wedge on two planes without cohesion.

R_A n_A + R_B n_B - T l = W z with the upward normals and the line of
intersection l, downwards; it slides where T = (R_A + R_B) tan(phi).
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
on_a, on_b, along = np.linalg.solve(np.transpose([a, b, -line]), [0, 0, 1])
friction = np.degrees(np.arctan(along / (on_a + on_b)))
np.savetxt(os.path.join(HERE, "reference.csv"), [[friction, on_a, on_b]],
           delimiter=",", fmt="%.6g", comments="",
           header="friction angle [deg],normal force on a [-],"
           "normal force on b [-]")
print("line of intersection, upwards:", -2 * line)
