#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Uniform stress by Hooke's law, and the joint by its two stiffnesses."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU = 20e9, 0.25
KN, KS = 80e9, 30e9
STRESS = np.array([[-100.0, 0.0, 50.0], [0.0, -100.0, -80.0],
                   [50.0, -80.0, -300.0]])
WIDTH, DEPTH, HEIGHT = 1.0, 0.8, 0.6

strain = ((1 + NU) * STRESS - NU * np.trace(STRESS) * np.eye(3)) / E
assert np.allclose(strain[:2, :2], 0.0)
# The vector area of the plane z = 0.2 + 0.2 x + y/16, upwards.
area = WIDTH * DEPTH * np.array([-0.2, -1 / 16, 1.0])
normal = area / np.linalg.norm(area)
traction = STRESS @ normal
across = traction @ normal
along = traction - across * normal
slip = along / KS
# No motion of the base: what it takes of the rotation is in the shear; the
# block above moves by opening and slip, too.
displacement = (HEIGHT * np.array([2 * strain[0, 2], 2 * strain[1, 2],
                                   strain[2, 2]])
                + across / KN * normal + slip)
# The lower side pulls the upper one back.
force = -STRESS @ area
reaction = -WIDTH * DEPTH * STRESS @ [0.0, 0.0, 1.0]
values = {
    "sxx_low [Pa]": STRESS[0, 0], "szz_low [Pa]": STRESS[2, 2],
    "syy_high [Pa]": STRESS[1, 1], "szz_high [Pa]": STRESS[2, 2],
    "sxz_high [Pa]": STRESS[0, 2], "syz_high [Pa]": STRESS[1, 2],
    "opening [m]": across / KN,
    "slip_x [m]": slip[0], "slip_y [m]": slip[1], "slip_z [m]": slip[2],
    "slip [m]": np.linalg.norm(slip),
    "normal [Pa]": across, "shear [Pa]": np.linalg.norm(along),
    "force_x [N]": force[0], "force_y [N]": force[1], "force_z [N]": force[2],
    "ux [m]": displacement[0], "uy [m]": displacement[1],
    "uz [m]": displacement[2],
    "reaction_x [N]": reaction[0], "reaction_z [N]": reaction[2]}
np.savetxt(os.path.join(HERE, "reference.csv"), [[0.0, *values.values()]],
           delimiter=",", fmt="%.12g", comments="",
           header=",".join(["time [s]", *values]))
