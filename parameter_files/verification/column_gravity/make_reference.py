#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Column under its own weight between smooth walls: uniaxial strain."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, RHO, GRAVITY, H, W = 10e9, 0.3, 2500.0, 9.81, 4.0, 1.0

confined = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
top = -RHO * GRAVITY * H**2 / (2 * confined)
np.savetxt(os.path.join(HERE, "reference.csv"),
           [[0, top, 0, RHO * GRAVITY * H * W]], delimiter=",", fmt="%.12g",
           comments="", header="time [s],top [m],side [m],reaction [N]")
