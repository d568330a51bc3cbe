#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Semicircular arch of straight-sided voussoirs.

  make_geometry.py [t/R [FILE]]
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from block_geometry import Geometry  # noqa: E402

RADIUS, VOUSSOIRS = 1.0, 27  # of the centre line


def ring(radius, number=VOUSSOIRS):
    """Corners from the left springing to the right one."""
    angles = np.pi * (1 - np.arange(number + 1) / number)
    # exactly level springings
    y = np.sin(angles)
    y[[0, -1]] = 0
    return radius * np.transpose([np.cos(angles), y])


def voussoirs(thickness, number=VOUSSOIRS):
    inner = ring(RADIUS - thickness / 2, number)
    outer = ring(RADIUS + thickness / 2, number)
    for k in range(number):
        yield [inner[k], inner[k + 1], outer[k + 1], outer[k]]


def write(path, ratio):
    geometry = Geometry("Semicircular arch, t/R = %g, %d voussoirs."
                        % (ratio, VOUSSOIRS))
    inner, outer = (RADIUS * (1 + s * ratio / 2) for s in (-1, 1))
    for a, b in ((-outer, -inner), (inner, outer)):
        geometry.add("abutment", [(a, -ratio), (b, -ratio), (b, 0), (a, 0)])
    for polygon in voussoirs(ratio * RADIUS):
        geometry.add("voussoir", polygon)
    geometry.write(path)


if __name__ == "__main__":
    write(sys.argv[2] if len(sys.argv) > 2 else
          os.path.join(HERE, "arch_thickness.geo"),
          float(sys.argv[1]) if len(sys.argv) > 1 else 0.11)
