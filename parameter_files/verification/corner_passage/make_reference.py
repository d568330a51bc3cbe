#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Normal forces under a block that is pushed over the junction of two others.

Statics of a rigid block on springs, at its vertices and at the ends of its
overlap with either block at half of the length between them each (the
trapezoidal rule of the contact). The
push acts at mid-height, friction mu W at the foot: the resultant lies
mu height/2 ahead of the centre. With the rotation held the traction is uniform
and the shares are those of the overlaps.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
L, HEIGHT, START, END = 0.5, 0.25, -1.3, 1.0    # slider; left end; table [m]
WEIGHT = 2000.0 * 10 * L * HEIGHT
MU = np.tan(np.radians(30))


def forces(travel, held, edges):
    """Forces on the left and on the right block; the slider, with so many
    edges at its foot, is on the table."""
    a = START + travel
    b = min(a + L, END)
    centre = a + L / 2
    cuts = np.unique(np.clip(np.append(a + np.arange(edges + 1) * L / edges,
                                       0), a, b))
    points = np.column_stack([cuts[:-1], cuts[1:]]).ravel() - centre
    weights = np.repeat(np.diff(cuts) / 2, 2)
    on_left = np.repeat(cuts[1:] <= 0, 2)
    if held:
        pressure = np.full(len(weights), WEIGHT / weights.sum())
    else:
        # pressure = u + t x with the resultant W at mu height/2
        matrix = [[weights.sum(), weights @ points],
                  [weights @ points, weights @ points**2]]
        u, t = np.linalg.solve(matrix, [WEIGHT, WEIGHT * MU * HEIGHT / 2])
        pressure = u + t * points
        assert np.all(pressure[weights > 0] > 0), "lifts off"
    n = pressure * weights
    return n[on_left].sum(), n[~on_left].sum()


if __name__ == "__main__":
    for name, held, last, edges in (("reference.csv", False, 1.9, 1),
                                    ("reference_fine.csv", False, 1.8, 3),
                                    ("reference_held.csv", True, 2.2, 1)):
        travel = np.arange(0, last + 1e-9, 5e-3)
        rows = np.array([forces(d, held, edges) for d in travel])
        np.savetxt(os.path.join(HERE, name),
                   np.column_stack([travel, rows]), delimiter=",",
                   fmt="%.9g", comments="",
                   header="travel [m],left [N],right [N]")
