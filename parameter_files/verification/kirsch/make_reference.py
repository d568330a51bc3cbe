#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacement of the wall of a hole, radius a, that is made in plane strain in
rock under the stress Sxx, Syy (Kirsch 1898):

  2 G u_r = a [m + (3 - 4 nu) d cos 2 t],   m = (Sxx + Syy) / 2,
  2 G u_t = -a (3 - 4 nu) d sin 2 t,        d = (Sxx - Syy) / 2.
"""
import os

HERE = os.path.dirname(os.path.abspath(__file__))
RADIUS, YOUNG, NU = 1.0, 10e9, 0.25


def write(name, sxx, syy):
    mean, half = (sxx + syy) / 2, (sxx - syy) / 2
    factor = RADIUS * (1 + NU) / YOUNG
    side = factor * (mean + (3 - 4 * NU) * half)
    crown = factor * (mean - (3 - 4 * NU) * half)
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write("time [s],side [m],crown [m]\n")
        stream.write("1,%.9g,%.9g\n" % (side, crown))


def main():
    write("reference.csv", -10e6, -5e6)
    write("reference_hydrostatic.csv", -10e6, -10e6)


if __name__ == "__main__":
    main()
