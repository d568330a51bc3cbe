#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Mean pressure q under a strip footing at collapse (Prandtl 1920), weightless
ground of the cohesion c, friction angle phi, load p beside the footing:

  q = c Nc + p Nq,  Nq = N exp(pi tan phi),  Nc = (Nq - 1)/tan phi,
  N = (1 + sin phi)/(1 - sin phi);  phi = 0: q = (2 + pi) c + p.

Smooth or rough; with phi > 0 for associated flow. reference.csv has q/c of
footings without load beside them.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def factors(degrees):
    """(Nc, Nq) of a friction angle [deg]."""
    phi = np.radians(degrees)
    if degrees == 0:
        return 2 + np.pi, 1.0
    number = (1 + np.sin(phi)) / (1 - np.sin(phi))
    surcharge = number * np.exp(np.pi * np.tan(phi))
    return (surcharge - 1) / np.tan(phi), surcharge


def check():
    assert abs(factors(0)[0] - 5.14159) < 1e-5
    # nothing jumps at phi = 0, and the usual table's value at 30 degrees
    assert abs(factors(1e-4)[0] - factors(0)[0]) < 1e-4
    assert abs(factors(30)[0] - 30.14) < 5e-3
    assert abs(factors(30)[1] - 18.40) < 5e-3


def main():
    check()
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("friction angle [deg],pressure over cohesion [-]\n")
        for degrees in range(0, 45, 5):
            stream.write("%g,%.9g\n" % (degrees, factors(degrees)[0]))


if __name__ == "__main__":
    main()
