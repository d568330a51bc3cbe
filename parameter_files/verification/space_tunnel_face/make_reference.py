#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacement of the wall of a round tunnel into it before and behind its face
(Unlu and Gercek 2003), as x at z = 0."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, PRESSURE, RADIUS = 10e9, 0.25, 10e6, 1.0
PLACES = {"behind_5": 5, "behind_3": 3, "behind_2": 2, "behind_1": 1,
          "behind_half": 0.5, "face": 0, "ahead_half": -0.5, "ahead_1": -1,
          "ahead_2": -2}

largest = PRESSURE * RADIUS * (1 + NU) / E
at_face = 0.22 * NU + 0.19


def share(x):
    """Of the largest displacement, at the distance x behind the face over the
    radius, negative before it."""
    if x < 0:
        return at_face * np.exp((0.73 * NU + 0.81) * x)
    b = 0.39 * NU + 0.65
    return at_face + (1 - at_face) * (1 - (b / (b + x))**2)


np.savetxt(os.path.join(HERE, "reference.csv"),
           [[0.0, *(-largest * share(x / RADIUS) for x in PLACES.values())]],
           delimiter=",", fmt="%.6g", comments="",
           header="time [s]," + ",".join(name + " [m]" for name in PLACES))
