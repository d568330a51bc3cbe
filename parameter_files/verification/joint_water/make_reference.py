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


def wedge(phi=45.0, density=2600.0):
    """Factor of safety of a wedge on a plane below a phreatic line."""
    x_top, y_top = 20.0, 12.0
    slope = y_top / x_top
    length = math.hypot(x_top, y_top)
    weight = 9.81 * density * 0.5 * (x_top - 12.0) * y_top

    def level(x):
        return 7 * x / 8 if x < 8 else 7 + 3 * (x - 8) / 12
    n = 100000
    uplift = sum(9810 * max(0.0, level(x) - slope * x)
                 for x in ((i + 0.5) * x_top / n for i in range(n)))
    uplift *= length / n
    sine, cosine = y_top / length, x_top / length
    return ((weight * cosine - uplift) * math.tan(math.radians(phi))
            / (weight * sine))


def main():
    write("factors.csv", "dry [-],uplift [-],wedge [-]", [dam() + (wedge(),)])
    # (density - water) times g times area of the block
    write("buoyancy.csv", "time [s],horizontal [N],vertical [N]",
          [(1.0, 0.0, (24e3 - 10e3) * 2.0 * 1.0)])
    # of the ground, 2 m wide, when the block is gone
    write("bared.csv", "time [s],reaction [N]", [(2.0, 2.0 * 3.0 * 1e4)])
    rows = []
    for k in range(10, 41):
        t = k / 40
        effective = 2.0 * (1e6 - 0.8e6 * max(0.0, 2 * t - 1))
        rows.append((t, -math.tan(math.radians(30)) * effective, effective))
    write("slip.csv", "time [s],horizontal [N],vertical [N]", rows)


if __name__ == "__main__":
    main()
