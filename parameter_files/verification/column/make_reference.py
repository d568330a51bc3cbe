#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Column in plane strain under an end load between free sides."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, H, W, LOAD = 10e9, 0.3, 4.0, 1.0, 1e3

plane = E / (1 - NU**2)
top = -LOAD * H / plane
side = LOAD * NU / (1 - NU) / plane * W
np.savetxt(os.path.join(HERE, "reference.csv"),
           [[0, top, side, 0, -LOAD, 0, LOAD * W]], delimiter=",",
           fmt="%.12g", comments="",
           header="time [s],top [m],side [m],sxx [Pa],syy [Pa],sxy [Pa],"
                  "reaction [N]")
