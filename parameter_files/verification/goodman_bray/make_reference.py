#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Limit equilibrium of a toppling slope, block by block from the crest.

Goodman & Bray (1976): the force P on the lower neighbour is the larger of what
keeps a block from toppling about its lower edge and from sliding on its base,
with limiting friction on its sides. The slope is in limiting equilibrium when
the block at the toe needs no force.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
WIDTH, UNIT_WEIGHT, DIP = 10.0, 25.0, np.radians(30)  # m, kN/m3
A1, A2, CREST = 5.0, 5.2, 10
HEIGHTS = [4.0 * i for i in range(1, 11)] + [33.8, 27.6, 21.4, 15.2, 9.0, 2.8]
STABLE, TOPPLES, SLIDES = 0, 1, 2


def equilibrium(mu):
    """Force that the toe needs [kN], {block: mode}, {block: forces}."""
    force, modes, forces = 0.0, {}, {}
    for block in range(len(HEIGHTS), 0, -1):
        height = HEIGHTS[block - 1]
        weight = UNIT_WEIGHT * height * WIDTH
        # heights at which the forces of both neighbours act
        above = height if block < CREST else height - A2
        below = height - A1 if block <= CREST else height
        toppling = -np.inf  # too low to have a neighbour's top below it
        if below > 0:
            toppling = (force * (above - mu * WIDTH) + weight / 2
                        * (height * np.sin(DIP) - WIDTH * np.cos(DIP))) / below
        sliding = force - (weight * (mu * np.cos(DIP) - np.sin(DIP))
                           / (1 - mu**2))
        force = max(toppling, sliding, 0.0)
        modes[block] = (STABLE if force == 0 else
                        TOPPLES if toppling > sliding else SLIDES)
        forces[block] = (toppling, sliding)
    return force, modes, forces


def limit():
    low, high = np.tan(np.radians((30, 44)))
    while high - low > 1e-12:
        middle = (low + high) / 2
        low, high = ((middle, high) if equilibrium(middle)[0] > 0
                     else (low, middle))
    return low


def main():
    mu = limit()
    angle = np.degrees(np.arctan(mu))
    _, modes, forces = equilibrium(mu)
    print("tan phi %.4f, phi %.2f degrees" % (mu, angle))
    for block in modes:
        print("%2d %-8s toppling %8.1f sliding %8.1f kN" % (
            block, ("stable", "topples", "slides")[modes[block]],
            *forces[block]))
    np.savetxt(os.path.join(HERE, "reference.csv"), [[angle]], fmt="%.6g",
               comments="", header="friction angle [deg]")
    # of columns with a friction angle of 45 degrees
    np.savetxt(os.path.join(HERE, "safety.csv"), [[1 / mu]], fmt="%.6g",
               comments="", header="toppling [-]")
    np.savetxt(os.path.join(HERE, "modes.csv"), sorted(modes.items()),
               fmt="%d", delimiter=",", comments="",
               header="block [-],mode [-]")


if __name__ == "__main__":
    main()
