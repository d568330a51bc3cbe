#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Two factors of the axle between which the arch with its fill falls.

Both are the last line of thrust in the arch (see ../../masonry/arch_bridge), the
axle spread downwards at 2 to 1. The lower one takes the fill as dead load; in the
upper one it also pushes on each voussoir with anything from its active to its
passive pressure (Rankine), as the line of thrust likes best. The numbers are those
of case.prm. Needs scipy (python3-scipy).
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../../masonry/arch_bridge"))
from thrust_line import joints, largest_factor, weights  # noqa: E402

SPAN, RISE, RING, VOUSSOIRS, LEVEL = 4.0, 1.0, 0.3, 19, 1.6
STONE, SOIL = 2200 * 9.81, 1835 * 9.81                  # [N/m^3]
FRICTION = np.tan(np.radians(35))
COHESION, ANGLE = 5e3, 35                               # of the fill
AXLE, PLACE, WIDTH = 100e3 / 2.5, -1.0, 0.6             # [N/m], on the road [m]


def main():
    lower, upper = joints(SPAN, RISE, RING, VOUSSOIRS)
    dead = weights(lower, upper, STONE)
    dead[:, 1] *= dead[:, 0]                            # moments
    live, push = np.zeros((2, VOUSSOIRS, 2))
    passive = np.tan(np.radians(45 + ANGLE / 2))**2
    share = (np.arange(400) + 0.5) / 400
    for k in range(VOUSSOIRS):
        a, b = upper[k], upper[k + 1]
        x, y = (a + share[:, None] * (b - a)).T
        dx, dy = (b - a)[0] / 400, abs((b - a)[1]) / 400
        depth = LEVEL - y
        force = SOIL * depth * dx
        dead[k] += [force.sum(), (force * x).sum()]
        spread = WIDTH + depth                          # 2 to 1 on both sides
        force = np.where(abs(x - PLACE) < spread / 2, AXLE / spread * dx, 0)
        live[k] = [force.sum(), (force * x).sum()]
        push[k] = [
            np.maximum(0, SOIL * depth / passive
                       - 2 * COHESION / passive**0.5).sum() * dy,
            (SOIL * depth * passive + 2 * COHESION * passive**0.5).sum() * dy]
    for loads in (dead, live):                          # places again
        loads[:, 1] /= np.where(loads[:, 0] > 0, loads[:, 0], 1)
    for name, given in (("as dead load", None), ("with its pressure", push)):
        print("fill %s: %.4f" % (name, largest_factor(
            lower, upper, dead, live, FRICTION, given)[0]))


if __name__ == "__main__":
    main()
