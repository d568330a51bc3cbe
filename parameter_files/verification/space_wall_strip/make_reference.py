#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Pressure [kPa] on a strip of wall of rigid units, which has cracked at the
lowest bed joint and at one above: writes reference.csv.

The lower part turns about its far edge, the upper one on the near edge of the
lower one, and the roof holds the middle of the head; both lean by the
displacement d of the upper crack. With the reaction R of the roof, moments

  about the upper crack:  R M - p b M^2/2 = P (t/2 - d) + w M (t - d)/2
  about the lower crack:  R L - p b L^2/2 = -P t/2 - w L (t - d)/2

with L above the lower crack, M above the upper one. The wall cracks where the
pressure is least.
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


def main():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                        "reference.csv")
    with open(path, "w", newline="") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(["time [s]", "factor [-]"])
        for time in np.linspace(1.6, 2, 11):
            # the mean displacement, of which the lowest course has none
            moved = 2 * 5e-4 * (time - 1) * N / (N - 1)
            table.writerow(["%.12g" % time, "%.12g" % (least(moved) / 1e3)])
    print("largest pressure: %.5g kPa" % (least(0.0) / 1e3))


if __name__ == "__main__":
    main()
