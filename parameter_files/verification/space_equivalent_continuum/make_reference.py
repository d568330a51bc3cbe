#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Box cut by three orthogonal sets of elastic joints with the spacings S_i: the strain
under a uniform stress is that of the rock and, over the spacing, the closures and slips
of the joints,

  1/E_i = 1/E + 1/(kn S_i),   1/G_ij = 1/G + 1/(ks S_i) + 1/(ks S_j),

while Poisson's ratio by E remains that of the rock.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, KN, KS, STRESS = 20e9, 0.25, 20e9, 8e9, 1e3
SIDES, SPACINGS = np.array([2, 1.5, 1.2]), np.array([1, 0.75, 0.4])
COLUMNS = ("x_right", "y_back", "z_top", "x_back", "x_top", "y_top")
PLANES = ((0, 1), (0, 2), (1, 2))


def rows():
    """Displacements at the end of each stage; the box is released before each shear."""
    for i in range(3):
        young = 1 / (1 / E + 1 / (KN * SPACINGS[i]))
        print("E_%s %.5g Pa" % ("xyz"[i], young))
        yield [SIDES[j] * STRESS * (1 / young if j == i else -NU / E)
               for j in range(3)] + [0, 0, 0]
    for k, (i, j) in enumerate(PLANES):
        shear = 1 / (2 * (1 + NU) / E + 1 / (KS * SPACINGS[i])
                     + 1 / (KS * SPACINGS[j]))
        print("G_%s%s %.5g Pa" % ("xyz"[i], "xyz"[j], shear))
        yield [0] * 6
        row = [0.0] * 6
        row[3 + k] = SIDES[j] * STRESS / shear
        yield row


if __name__ == "__main__":
    table = [[i, *row] for i, row in enumerate(rows(), 1)]
    np.savetxt(os.path.join(HERE, "reference.csv"), table, delimiter=",",
               fmt="%.9g", comments="", header="stage [-]," + ",".join(
                   name + " [m]" for name in COLUMNS))
