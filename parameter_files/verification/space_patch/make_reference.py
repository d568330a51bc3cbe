#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Uniform stress by Hooke's law: the displacements are linear in z."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU = 20e9, 0.25
STRESS = np.array([[-100.0, 0.0, 50.0], [0.0, -100.0, -80.0],
                   [50.0, -80.0, -300.0]])
WIDTH, DEPTH, HEIGHT = 1.0, 0.8, 0.6

strain = ((1 + NU) * STRESS - NU * np.trace(STRESS) * np.eye(3)) / E
assert np.allclose(strain[:2, :2], 0.0)
# No motion of the base: what it takes of the rotation is in the shear.
displacement = HEIGHT * np.array([2 * strain[0, 2], 2 * strain[1, 2],
                                  strain[2, 2]])
principal = np.sort(np.linalg.eigvalsh(STRESS))[::-1]
# Of the base on the block, against the traction on the top.
reaction = -WIDTH * DEPTH * STRESS @ [0.0, 0.0, 1.0]
row = [0.0, STRESS[0, 0], STRESS[1, 1], STRESS[2, 2], STRESS[0, 1],
       STRESS[0, 2], STRESS[1, 2], *principal, *displacement, *reaction]
names = ["s" + n for n in ("xx", "yy", "zz", "xy", "xz", "yz", "1", "2", "3")]
header = (["time [s]"] + [n + " [Pa]" for n in names]
          + ["u%s [m]" % d for d in "xyz"]
          + ["reaction_%s [N]" % d for d in "xyz"])
np.savetxt(os.path.join(HERE, "reference.csv"), [row], delimiter=",",
           fmt="%.12g", comments="", header=",".join(header))
