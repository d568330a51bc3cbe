#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""One joint pulled open beyond its tensile strength, then closed and pressed.

Normal traction: slope kn to ft, then the residual strength while open; the
broken joint carries compression again as soon as it closes.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
KN, STRENGTH = 10e9, 0.5e6

times = np.arange(0, 0.4, 1e-3)
opening = 0.2e-3 * np.sin(2 * np.pi * times / 0.4)
breaks = 0.4 / (2 * np.pi) * np.arcsin(STRENGTH / KN / 0.2e-3)
for name, residual in (("reference.csv", 0.0), ("reference_residual.csv", 1e5)):
    normal = np.where(times < breaks, KN * opening,
                      np.minimum(KN * opening, residual))
    if residual > 0:
        # closing is elastic from the opened state: compare up to there
        keep = times <= 0.1
    else:
        keep = times >= 0
    np.savetxt(os.path.join(HERE, name),
               np.transpose([times, 0 * times, opening, normal,
                             0 * times])[keep],
               delimiter=",", fmt="%.9g", comments="",
               header="time [s],slip [m],opening [m],normal [Pa],shear [Pa]")
