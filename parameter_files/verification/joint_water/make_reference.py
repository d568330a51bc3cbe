#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""References by statics of rigid bodies: see README.md."""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def write(name, head, rows):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write(head + "\n")
        for row in rows:
            stream.write(",".join("%.12g" % value for value in row) + "\n")


def dam(height=50.0, width=40.0, concrete=24e3, water=10e3, phi=50.0):
    """Factors of safety against sliding on the foot, dry and with an uplift
    that falls from the full head at the heel to zero at the toe."""
    weight = 0.5 * concrete * height * width
    push = 0.5 * water * height**2
    uplift = 0.5 * water * height * width
    mu = math.tan(math.radians(phi))
    return mu * weight / push, mu * (weight - uplift) / push


def main():
    write("factors.csv", "dry [-],uplift [-]", [dam()])
    # (density - water) times g times area of the block
    write("buoyancy.csv", "time [s],horizontal [N],vertical [N]",
          [(1.0, 0.0, (24e3 - 10e3) * 2.0 * 1.0)])
    rows = []
    for k in range(10, 41):
        t = k / 40
        effective = 2.0 * (1e6 - 0.8e6 * max(0.0, 2 * t - 1))
        rows.append((t, -math.tan(math.radians(30)) * effective, effective))
    write("slip.csv", "time [s],horizontal [N],vertical [N]", rows)


if __name__ == "__main__":
    main()
