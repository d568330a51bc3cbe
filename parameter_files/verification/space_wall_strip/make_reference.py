#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes reference.csv, the pressure [kPa] on a strip of wall of rigid units,
which has cracked at the lowest bed joint and at one above, reference_free.csv,
the acceleration [g] at which a strip that is free at its top overturns, and
reference_crack_2.csv, reference_crack_4.csv and reference_roof_crack.csv, how the
lowest joint closes until its edge opens.

Of the wall that has cracked, the lower part turns about its far edge, the upper one on the near edge of the
lower one, and the roof holds the middle of the head; both lean by the
displacement d of the upper crack. With the reaction R of the roof, moments

  about the upper crack:  R M - p b M^2/2 = P (t/2 - d) + w M (t - d)/2
  about the lower crack:  R L - p b L^2/2 = -P t/2 - w L (t - d)/2

with L above the lower crack, M above the upper one. The wall cracks where the
pressure is least.

The free strip turns about the far edge of its lowest joint by the angle theta,

  a/g = tan(atan(t/L) - theta).

A joint opens at its edge where M = N t/6, the kern of its section. With n faces
over the thickness the nodes of a joint have the second moment of area
t^3/12 (1 + 2/n^2), and it opens where M = N t/6 (1 + 2/n^2).
"""
import csv
import os

import numpy as np

N, HEIGHT, THICKNESS, LENGTH = 16, 2.4, 0.12, 0.24
ROOF = 4e3  # [N]
WEIGHT = 2000 * 10 * THICKNESS * LENGTH  # [N/m]


def pressure(crack, moved):
    """Pressure [Pa] of cracks below the courses 1 and @p crack."""
    t, above = THICKNESS, HEIGHT * (1 - 1 / N)
    top = HEIGHT * (1 - crack / N)
    moments = (ROOF * t / 2 + WEIGHT * above * (t - moved) / 2
               + above / top * (ROOF * (t / 2 - moved)
                                + WEIGHT * top * (t - moved) / 2))
    return moments / (LENGTH * above * (above - top) / 2)


def least(moved):
    return min(pressure(crack, moved) for crack in range(2, N))


def section(faces):
    """Modulus of a joint's section by its area [m]."""
    return THICKNESS / 6 * (1 + 2 / faces**2)


def opening(normal, moment, faces, stiffness):
    """Opening of the edge [m] between rigid units of a joint with as many faces
    over the thickness, under a force [N] and a bending moment [N m]."""
    y = np.linspace(0, THICKNESS, faces + 1)
    share = np.full(faces + 1, 1 / faces)
    share[[0, -1]] /= 2
    spring = stiffness * share * THICKNESS * LENGTH
    closed = np.ones(faces + 1, dtype=bool)
    arm = y - THICKNESS / 2
    while True:
        k = spring * closed
        matrix = [[k.sum(), k @ arm], [k @ arm, k @ arm**2]]
        closure, turn = np.linalg.solve(matrix, [normal, moment])
        found = closure + turn * arm > 0
        if np.all(found == closed):
            return -(closure + turn * arm)[0]
        closed = found


def cracks(normal, by_time, faces):
    """Seconds after which the edge opens, of a moment that grows with time."""
    return normal * section(faces) / by_time


def reaction(courses, faces, stiffness, shear_stiffness, young):
    """Reaction of the roof by the pressure [m^2]: joints between units that bend
    and shear as beams."""
    height = courses * HEIGHT / N
    inertia, area = LENGTH * THICKNESS**3 / 12, LENGTH * THICKNESS
    poisson = 0.15
    bend = stiffness * area * section(faces) * THICKNESS / 2
    slip = shear_stiffness * area
    rigidity = young * inertia / (1 - poisson**2)
    shear = 5 / 6 * area * young / (2 * (1 + poisson))
    joints = HEIGHT / N * np.arange(1, courses)    # depth below the head
    x = (np.arange(1000) + 0.5) * height / 1000
    dx = height / 1000
    by_load = (np.sum(joints**3 / 2) / bend + np.sum(joints) / slip
               + dx * np.sum(x**3 / 2 / rigidity + x / shear))
    by_roof = (np.sum(joints**2) / bend + len(joints) / slip
               + dx * np.sum(x**2 / rigidity + 1 / shear))
    return LENGTH * by_load / by_roof


def write(name, columns, rows):
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    with open(path, "w", newline="") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(columns)
        for row in rows:
            table.writerow(["%.12g" % value for value in row])


def main():
    # the mean displacement, of which the lowest course has none
    def lean(time, speed):
        return 2 * speed * (time - 1) * N / (N - 1)

    write("reference.csv", ["time [s]", "factor [-]"],
          [(time, least(lean(time, 5e-4)) / 1e3)
           for time in np.linspace(1.6, 2, 11)])
    above = HEIGHT * (1 - 1 / N)
    write("reference_free.csv", ["time [s]", "factor [-]"],
          [(time, np.tan(np.arctan(THICKNESS / above)
                         - lean(time, 2e-3) / above))
           for time in np.linspace(1.1, 1.5, 9)])
    low = 3 * HEIGHT / N
    for faces in (2, 4):
        normal, by_time = WEIGHT * low, 0.16 * WEIGHT * low**2 / 2
        print("%d faces: the free strip cracks at %.5g g, overturns at %.5g g"
              % (faces, 0.16 * cracks(normal, by_time, faces),
                 THICKNESS / low))
        write("reference_crack_%d.csv" % faces, ["time [s]", "opening [m]"],
              [(1 + t, opening(normal, by_time * t, faces, 5e9))
               for t in np.linspace(0, 1, 21)])
    roof = reaction(8, 2, 20e9, 8e9, 200e9)
    above = 7 * HEIGHT / N
    normal = ROOF + WEIGHT * above
    by_time = 8000 * (LENGTH * above**2 / 2 - roof * above)
    end = cracks(normal, by_time, 2)
    write("reference_roof_crack.csv",
          ["time [s]", "opening [m]", "head [N]"],
          [(1 + t, opening(normal, by_time * t, 2, 20e9), -8000 * t * roof)
           for t in np.linspace(0, 0.95 * end, 11)])
    print("2 faces: the strip cracks below the roof at %.5g Pa, of which that "
          "bears %.4g" % (8000 * end, roof / LENGTH / (HEIGHT / 2)))
    print("largest pressure: %.5g kPa" % (least(0.0) / 1e3))


if __name__ == "__main__":
    main()
