#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Weight on the base of a box of rock without its bodies: density times volume.

Writes reference.csv: at the end of each stage the reaction [N].
"""
import math

DENSITY, GRAVITY = 2500.0, 10.0


def arch(width, wall, rise, chords):
    """Area of a section with straight walls and a roof of chords [m^2]."""
    radius = (width ** 2 / 4 + rise ** 2) / (2 * rise)
    angle = 2 * math.asin(width / 2 / radius)
    # the sectors of the chords less the triangle below the roof
    roof = (chords * radius ** 2 / 2 * math.sin(angle / chords)
            - radius ** 2 / 2 * math.sin(angle))
    return width * wall + roof


def reactions():
    box = 12 * 10 * 10
    # two benches, from x = -6: to -4 m above z = 8, to -1 m above z = 6.5 m
    air = 10 * (2 * (10 - 8) + 3 * (10 - 6.5))
    section = arch(3.0, 1.5, 1.0, 6)
    return [DENSITY * GRAVITY * (box - air - length * section)
            for length in (0, 2, 7)]


if __name__ == "__main__":
    with open("reference.csv", "w") as stream:
        stream.write("time [s],reaction [N]\n")
        for stage, force in enumerate(reactions()):
            stream.write("%d,%.10g\n" % (stage + 1, force))
