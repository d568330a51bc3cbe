#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Two blocks, heights h, moduli E_1 and E_2, on a joint of stiffness kn under the
pressure p, without Poisson's effect: p is everywhere, and an increment of it

  closes the joint by dp/kn and lowers the top by dp (h/E_1 + h/E_2 + 1/kn)

with the stiffness of that time. A change of stiffness moves nothing. A row a stage.
"""
import os

HERE = os.path.dirname(os.path.abspath(__file__))
HEIGHT = 0.5
STONE, SOFT_STONE = 20e9, 5e9
BED, SOFT_BED = 50e9, 10e9


def main():
    stages = [(1e6, STONE, BED), (0.0, SOFT_STONE, SOFT_BED),
              (2e6, SOFT_STONE, SOFT_BED)]
    top = opening = pressure = 0.0
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("stage [-],top [m],opening [m],traction [Pa],"
                     "stress [Pa]\n")
        for i, (step, upper, joint) in enumerate(stages):
            pressure += step
            opening -= step / joint
            top -= step * (HEIGHT / STONE + HEIGHT / upper + 1 / joint)
            stream.write("%d,%.9g,%.9g,%.9g,%.9g\n"
                         % (i + 1, top, opening, -pressure, -pressure))


if __name__ == "__main__":
    main()
