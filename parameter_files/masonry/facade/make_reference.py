#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Factor of the slabs' weight, sideways, at which the facade slides on the felt
below course 2: tan(phi) W by the weight of the slabs, W being all that lies above
the felt. The numbers are those of case.prm; the times those of rows in the second
third of the stage, while all of it slides."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LENGTH, COURSE, SLAB = 6.0, 0.25, 0.25
UNIT, CONCRETE, FLOOR = 1800, 2400, 10000               # [kg/m^3]
FRICTION = np.tan(np.radians(11.3099))

# courses above the felt, widths and courses of the openings, one lintel each
storeys = [(10, [(1.0, 8), (1.0, 5)]), (10, [(1.0, 5), (1.0, 5)])]
units = lintels = 0.0
for courses, openings in storeys:
    area = LENGTH * courses * COURSE
    for width, high in openings:
        bridge = (width + 2 * 0.25) * COURSE
        area -= width * high * COURSE + bridge
        lintels += bridge
    units += area
floors = FLOOR * LENGTH * SLAB * len(storeys)
factor = FRICTION * (UNIT * units + CONCRETE * lintels + floors) / floors
np.savetxt(os.path.join(HERE, "reference.csv"),
           [[t, factor] for t in np.linspace(1.6, 1.82, 12)], delimiter=",",
           fmt="%.6g", comments="", header="time [s],load_factor [-]")
print("factor %.5f" % factor)
