#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Yield-line loads of the wall [kPa], which lie on both sides of its largest
pressure: with the moments at which joints crack, and with those of joints that
keep their strength while they open.

A vertical yield line from the top meets two lines from the corners of the base
at a height z. With the displacement 1 along the vertical line the sides turn by
2/L about the supports, the part below by 1/z about the base.
"""
import numpy as np

LENGTH, HEIGHT, THICKNESS, UNIT, COURSE = 1.2, 0.8, 0.12, 0.24, 0.1
TENSION, COHESION = 0.25e6, 0.35e6


def load(bed, head, torsion):
    """The least over z, for moments by length of bed and head joints [N] and
    the torsion of what overlaps of a bed joint [N m]."""
    z = np.linspace(0.1, HEIGHT, 141)
    across = head + torsion / COURSE
    work = 2 * across * HEIGHT * 2 / LENGTH + 2 * bed * LENGTH / z
    volume = LENGTH * ((HEIGHT - z) / 2 + z / 3)
    return float(np.min(work / volume))


def bounds():
    """The two loads [Pa]; the overlap of two units is a square."""
    assert UNIT / 2 == THICKNESS
    bending = TENSION * THICKNESS ** 2
    twist = COHESION * THICKNESS ** 3
    return (load(bending / 6, bending / 6, 0.208 * twist),
            load(bending / 2, bending / 2, twist / 3))


if __name__ == "__main__":
    print("between %.3g and %.3g kPa" % tuple(1e-3 * q for q in bounds()))
