#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A rigid block on a plane of b degrees, held by friction until it falls to phi at
0.1 s, slides by a (t - 0.1)^2/2, a = g (sin b - cos b tan phi).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
G, SLOPE, FRICTION, BEGINS, ENDS = 10.0, 35.0, 20.0, 0.1, 0.3


def main():
    b, phi = np.radians(SLOPE), np.radians(FRICTION)
    a = G * (np.sin(b) - np.cos(b) * np.tan(phi))
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("time [s],slip [m]\n")
        for t in np.linspace(0, ENDS, 31):
            stream.write("%.9g,%.9g\n" % (t, a * max(t - BEGINS, 0)**2 / 2))


if __name__ == "__main__":
    main()
