#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacement of the wall of a round tunnel at the end of each round of its
advance, by the formula of make_reference.py about the face of the round."""
import os

import numpy as np

from make_reference import HERE, RADIUS, largest, share

FACES = {0.03: -4, 0.06: -2, 0.09: 0}
PLACES = {"at_m5": -5, "at_m3": -3, "at_m2_5": -2.5, "at_m1": -1,
          "at_m0_5": -0.5, "at_0": 0, "at_0_5": 0.5, "at_1": 1, "at_2": 2}

np.savetxt(os.path.join(HERE, "reference_advance.csv"),
           [[time, *(-largest * share((face - y) / RADIUS)
                     for y in PLACES.values())]
            for time, face in FACES.items()],
           delimiter=",", fmt="%.6g", comments="",
           header="time [s]," + ",".join(name + " [m]" for name in PLACES))
