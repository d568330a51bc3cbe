#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A block of weight W on a plane inclined by a, with a bolt that yields at T and
whose direction from its head has the components -t down the plane and -n off it:

  F = ((W cos a + T n) tan phi + c A)/(W sin a - T t) .

A rough joint without bolt has phi = phi_r + JRC log10(JCS/s) under the mean
pressure s."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
WEIGHT = 2700 * 0.4 * 10
SLOPE, FRICTION = np.radians(35), np.radians(40)
YIELD = 3e3
LENGTH = np.hypot(0.3, 0.7)
COHESION = 4e3  # over 1 m^2
# of a Barton-Bandis joint, JRC and JCS
ROUGHNESS, WALL = 5., 50e6


def factor(force, cohesion=0., friction=FRICTION):
    return (((WEIGHT * np.cos(SLOPE) + force * 0.7 / LENGTH)
             * np.tan(friction) + cohesion)
            / (WEIGHT * np.sin(SLOPE) - force * 0.3 / LENGTH))


def rough(residual):
    pressure = WEIGHT * np.cos(SLOPE)
    angle = residual + ROUGHNESS * np.log10(WALL / pressure)
    return np.tan(np.radians(angle)) / np.tan(SLOPE)


with open(os.path.join(HERE, "factors.csv"), "w") as stream:
    stream.write("bolted [-],without [-],cohesive [-],rough [-],smooth [-],"
                 "passive [-]\n%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n"
                 % (factor(YIELD), factor(0), factor(YIELD, COHESION),
                    rough(37.), rough(30.),
                    factor(YIELD, friction=np.radians(30.))))
