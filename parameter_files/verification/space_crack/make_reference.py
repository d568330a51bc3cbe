#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A penny-shaped crack in tension (Sneddon 1946): its opening in the middle, at
half its radius and at its front, and its state, open."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, TENSION, RADIUS = 10e9, 0.25, 1e5, 1.0

r = np.array([0.0, 0.5, 1.0])
opening = (8 * (1 - NU**2) / (np.pi * E) * TENSION
           * np.sqrt(RADIUS**2 - r**2))
np.savetxt(os.path.join(HERE, "reference.csv"), [[0.0, *opening, 3.0]],
           delimiter=",", fmt="%.9g", comments="",
           header="time [s],middle [m],half [m],mouth [m],state [-]")
