#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Axial strength of a specimen with parallel joints: the lower one of joints
(Jaeger 1960) and rock (Mohr-Coulomb), with the joint's plane at the angle beta
to the direction of the confining pressure."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
CONFINEMENT, WIDTH, END = 2e6, 1.0, 0.5
JOINT_COHESION, JOINT_ANGLE = 1e6, np.radians(30)
COHESION, ANGLE = 3e6, np.radians(38)

for beta in (40, 50, 60, 85):
    b, tan = np.radians(beta), np.tan(JOINT_ANGLE)
    joint = CONFINEMENT + 2 * (JOINT_COHESION + CONFINEMENT * tan) / (
        (1 - tan / np.tan(b)) * np.sin(2 * b))
    number = (1 + np.sin(ANGLE)) / (1 - np.sin(ANGLE))
    rock = CONFINEMENT * number + 2 * COHESION * np.sqrt(number)
    print("beta %d: joint %.3f MPa, rock %.3f MPa"
          % (beta, joint / 1e6, rock / 1e6))
    np.savetxt(os.path.join(HERE, "reference_%d.csv" % beta),
               [[0, 0], [END, -WIDTH * min(joint, rock)]], delimiter=",",
               fmt="%.9g", comments="", header="time [s],force [N]")

# A brittle joint at 60 degrees, unconfined, that has slipped on with its residual
# cohesion and friction.
b, tan, thickness = np.radians(60), np.tan(np.radians(25)), 0.2
residual = 2 * 50e3 / ((1 - tan / np.tan(b)) * np.sin(2 * b))
np.savetxt(os.path.join(HERE, "reference_brittle.csv"),
           [[0, 0], [1, thickness * WIDTH * residual]], delimiter=",",
           fmt="%.9g", comments="", header="time [s],force [N]")
