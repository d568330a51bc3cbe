#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Liner of a hole of radius a, placed before the rock is relaxed.

Hydrostatic stress P0, the liner a thin ring:

  p = P0 / (1 + 2 G a (1 - nu_s^2) / (E_s t)),   N = -p a.

Stress P vertical and K P horizontal (Einstein and Schwartz 1979), t from the
horizontal:

  C = E a (1 - nu_s^2) / (E_s A_s (1 - nu^2)),  F = E a^3 (1 - nu_s^2) / (E_s I_s (1 - nu^2)),
  a0 = C F (1 - nu) / (C + F + C F (1 - nu)),
  full slip:
    a2 = (F + 6)(1 - nu) / (2 F (1 - nu) + 6 (5 - 6 nu)),
    T/(P a)   = (1 + K)(1 - a0)/2 + (1 - K)(1 - 2 a2)/2 cos 2 t,
    M/(P a^2) = (1 - K)(1 - 2 a2)/2 cos 2 t,
  no slip:
    b  = ((6 + F) C (1 - nu) + 2 F nu) / (3 F + 3 C + 2 C F (1 - nu)),
    b2 = C (1 - nu) / (2 (C (1 - nu) + 4 nu - 6 b - 3 b C (1 - nu))),  a2 = b b2,
    T/(P a)   = (1 + K)(1 - a0)/2 + (1 - K)(1 + 2 a2)/2 cos 2 t,
    M/(P a^2) = (1 - K)(1 - 2 a2 + 2 b2)/4 cos 2 t.

Here P is along x, so that t counts from y. Thrusts are compressive, moments positive
where the liner becomes rounder. To Einstein's and Schwartz's moments is added that
of the mean contraction, which they leave out: the curvature of a ring whose radius
a becomes a + u grows by -u/a^2, so with u = -N a / (E_s A_s) by M = N I_s/(A_s a).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RADIUS, YOUNG, NU = 1.0, 10e9, 0.25
LINER_YOUNG, LINER_NU, LINER_THICKNESS = 30e9, 0.2, 0.1


def hydrostatic(pressure=10e6):
    """Displacement of the wall [m] and thrust [N]."""
    shear = YOUNG / (2 * (1 + NU))
    p = pressure / (1 + 2 * shear * RADIUS * (1 - LINER_NU ** 2)
                    / (LINER_YOUNG * LINER_THICKNESS))
    return -(pressure - p) * RADIUS / (2 * shear), -p * RADIUS


def einstein_schwartz(slips, pressure=10e6, ratio=0.5):
    """Thrust at x and y axis [N] and moment there [N m], as the program's."""
    plain = (1 - LINER_NU ** 2) / (LINER_YOUNG * (1 - NU ** 2)) * YOUNG
    c = plain * RADIUS / LINER_THICKNESS
    f = plain * RADIUS ** 3 / (LINER_THICKNESS ** 3 / 12)
    a0 = c * f * (1 - NU) / (c + f + c * f * (1 - NU))
    if slips:
        a2 = (f + 6) * (1 - NU) / (2 * f * (1 - NU) + 6 * (5 - 6 * NU))
        thrust = moment = 0.5 * (1 - ratio) * (1 - 2 * a2)
    else:
        b = (((6 + f) * c * (1 - NU) + 2 * f * NU)
             / (3 * f + 3 * c + 2 * c * f * (1 - NU)))
        b2 = c * (1 - NU) / (2 * (c * (1 - NU) + 4 * NU - 6 * b
                                  - 3 * b * c * (1 - NU)))
        a2 = b * b2
        thrust = 0.5 * (1 - ratio) * (1 + 2 * a2)
        moment = 0.25 * (1 - ratio) * (1 - 2 * a2 + 2 * b2)
    mean = 0.5 * (1 + ratio) * (1 - a0)
    sizes = pressure * RADIUS, pressure * RADIUS ** 2
    contraction = sizes[0] * mean * LINER_THICKNESS ** 2 / 12 / RADIUS
    return (-sizes[0] * (mean - thrust), -sizes[0] * (mean + thrust),
            contraction - sizes[1] * moment, contraction + sizes[1] * moment)


def main():
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("time [s],wall [m],thrust_side [N],thrust_crown [N]\n")
        u, n = hydrostatic()
        stream.write("1,%.9g,%.9g,%.9g\n" % (u, n, n))
    for name, slips in (("no_slip", False), ("full_slip", True)):
        with open(os.path.join(HERE, name + ".csv"), "w") as stream:
            stream.write("time [s],thrust_side [N],thrust_crown [N],"
                         "moment_side [N m],moment_crown [N m]\n")
            stream.write("1,%.9g,%.9g,%.9g,%.9g\n" % einstein_schwartz(slips))


if __name__ == "__main__":
    main()
