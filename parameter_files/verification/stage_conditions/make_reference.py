#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""One joint pulled until it breaks, closed, and pressed to a traction.

The platen moves by constant velocities, and each stage ends at the first row
of the histories at which its condition holds: the joint breaks at ft/kn, is
closed again at zero opening, and bears kn times its closure from there on.
"""
import math
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, STRENGTH, BOUND = 10e9, 0.5e6, 4.2e5
PULL, PRESS, ROW = 4.7e-3, 3.1e-3, 2.5e-4


def row_after(time):
    return ROW * math.ceil(time / ROW)


torn = row_after(STRENGTH / KN / PULL)
touches = torn * (1 + PULL / PRESS)
closed = row_after(touches)
squeezed = row_after(touches + BOUND / KN / PRESS)

if __name__ == "__main__":
    t = ROW * np.arange(round(squeezed / ROW) + 1)
    opening = np.where(t < torn, PULL * t, PRESS * (touches - t))
    traction = np.where(t < torn, KN * opening, KN * np.minimum(opening, 0))
    np.savetxt(os.path.join(HERE, "reference.csv"),
               np.transpose([t, opening, traction]), delimiter=",",
               fmt="%.9g", comments="",
               header="time [s],opening [m],normal traction [Pa]")
    print("torn %.4f, closed %.4f, squeezed %.4f s" % (torn, closed, squeezed))
