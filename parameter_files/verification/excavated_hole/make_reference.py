#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Wall of a hole, radius a, from which a share of the in-situ tractions is gone.

Elastic, under Sxx, Syy (Kirsch 1898): what is gone times

  2 G u_r = a^2/r [m + (4 - 4 nu - a^2/r^2) d cos 2 t],   m = (Sxx + Syy) / 2,
  2 G u_t = -a^2/r (2 - 4 nu + a^2/r^2) d sin 2 t,        d = (Sxx - Syy) / 2.

Mohr-Coulomb, under the pressure P0 with the support pi = (1 - share) P0
(Salencon 1969), psi = phi. Pressures positive here, K = (1 + sin phi)/(1 - sin phi),
p = 2 c sqrt(K)/(K - 1):

  R0 = a [2/(K + 1) (P0 + p)/(pi + p)]^(1/(K - 1))     radius of the plastic zone
  s_R = (2 P0 - (K - 1) p)/(K + 1)                     radial pressure there
  r > R0: 2 G u = (P0 - s_R) R0^2/r                    towards the hole
  r < R0: 2 G u/r = (2 nu - 1) (P0 + p)
          + (1 - nu) (K^2 - 1)/(2 K) (pi + p) (R0/a)^(K - 1) (R0/r)^(K + 1)
          + ((1 - nu) (K^2 + 1)/(2 K) - nu) (pi + p) (r/a)^(K - 1)

Lined: a ring of concrete, outer radius a, inner b, on a joint of stiffness kn, put in
when a share of the tractions P0 is gone, bears the pressure q of the rest by

  (1 - share) P0 a/2G - q a/2G = q c + q/kn,
  c = a (1 + nu_c)/E_c ((1 - 2 nu_c) a^2 + b^2)/(a^2 - b^2)

(Lame): the wall, the joint and the ring move together.

reference.csv has the elastic wall, reference_yielding.csv the other, reference_lining.csv
wall and inner side of the lining and the joint's traction, a row a stage.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RADIUS = 1.0
YOUNG, NU = 10e9, 0.25
SXX, SYY = -10e6, -5e6

PRESSURE = 30e6
SHEAR, BULK = 2.8e9, 3.9e9
NU_YIELDING = (3 * BULK - 2 * SHEAR) / (2 * (3 * BULK + SHEAR))
COHESION, FRICTION = 3.45e6, 30.0
K = (1 + np.sin(np.radians(FRICTION))) / (1 - np.sin(np.radians(FRICTION)))
P = 2 * COHESION * np.sqrt(K) / (K - 1)
EDGE_PRESSURE = (2 * PRESSURE - (K - 1) * P) / (K + 1)


def elastic(share, angle, sxx=SXX, syy=SYY, r=RADIUS):
    """Radial and tangential displacement [m], outward and anticlockwise."""
    mean, half = (sxx + syy) / 2, (sxx - syy) / 2
    near = (RADIUS / r) ** 2
    factor = share * RADIUS ** 2 / r * (1 + NU) / YOUNG
    return (factor * (mean + (4 - 4 * NU - near) * half * np.cos(2 * angle)),
            -factor * (2 - 4 * NU + near) * half * np.sin(2 * angle))


def plastic_radius(share):
    support = (1 - share) * PRESSURE
    return RADIUS * (2 / (K + 1) * (PRESSURE + P)
                     / (support + P)) ** (1 / (K - 1))


def yielding(share, r):
    """Radial displacement [m], outward positive."""
    support, outer = (1 - share) * PRESSURE, plastic_radius(share)
    outside = (PRESSURE - EDGE_PRESSURE) * outer ** 2 / r
    inside = r * ((2 * NU_YIELDING - 1) * (PRESSURE + P)
                  + (1 - NU_YIELDING) * (K ** 2 - 1) / (2 * K) * (support + P)
                  * (outer / RADIUS) ** (K - 1) * (outer / r) ** (K + 1)
                  + ((1 - NU_YIELDING) * (K ** 2 + 1) / (2 * K) - NU_YIELDING)
                  * (support + P) * (r / RADIUS) ** (K - 1))
    return -np.where(r < outer, inside, outside) / (2 * SHEAR)


def lining(share=0.5, pressure=10e6):
    """Displacements of the rock's wall and the lining's inner side [m] and
    traction of the joint [Pa] at the end of both stages, outward and tension
    positive."""
    inner, young, nu, stiffness = 0.9, 30e9, 0.2, 2e11
    a2, b2 = RADIUS**2, inner**2
    rock = RADIUS * (1 + NU) / YOUNG
    ring = RADIUS * (1 + nu) / young * ((1 - 2 * nu) * a2 + b2) / (a2 - b2)
    rest = (1 - share) * pressure
    q = rest * rock / (rock + ring + 1 / stiffness)
    inside = 2 * (1 - nu**2) / young * q * a2 * inner / (a2 - b2)
    return ((-share * pressure * rock, 0.0, 0.0),
            (-share * pressure * rock - (rest - q) * rock, -inside, -q))


def check():
    """Both formulas meet at R0, and without support are the known numbers."""
    for share in (0.8, 1.0):
        outer = plastic_radius(share)
        assert abs(yielding(share, outer * (1 - 1e-12))
                   / yielding(share, outer * (1 + 1e-12)) - 1) < 1e-9
    assert abs(plastic_radius(1.0) - 1.735) < 5e-4
    assert abs(-yielding(1.0, RADIUS) - 28.10e-3) < 5e-6


def main():
    check()
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("stage [-],side [m],crown [m]\n")
        for time, share in ((1, 0.5), (2, 1.0)):
            stream.write("%g,%.9g,%.9g\n"
                         % (time, elastic(share, 0.0)[0],
                            elastic(share, np.pi / 2)[0]))
    with open(os.path.join(HERE, "reference_lining.csv"), "w") as stream:
        stream.write("stage [-],wall [m],lining [m],pressure [Pa]\n")
        for stage, row in enumerate(lining()):
            stream.write("%d,%.9g,%.9g,%.9g\n" % (stage + 1, *row))
    with open(os.path.join(HERE, "reference_yielding.csv"), "w") as stream:
        stream.write("share [-],u_r wall [m],plastic radius [m]\n")
        for share in (0.8, 1.0):
            stream.write("%g,%.9g,%.9g\n" % (share, yielding(share, RADIUS),
                                             plastic_radius(share)))


if __name__ == "__main__":
    main()
