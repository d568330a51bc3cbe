#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The bar of ../bar along (2, 3, 6)/7: turned.csv."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LENGTH, SPEED, YOUNG, LOAD = 10.0, 4000.0, 40e9, 1e6
AXIS = np.array([2, 3, 6]) / 7


def displacement(distance, times):
    """Along the bar, at a distance from the held end: waves of the load, which
    change sign at that end, have passed for p/E times how far they are by."""
    total = np.zeros_like(times)
    for k in range(int(SPEED * times[-1] / LENGTH) + 2):
        to, fro = (2 * k + 1) * LENGTH - distance, (2 * k + 1) * LENGTH + distance
        total += (-1)**k * (np.maximum(SPEED * times - to, 0)
                            - np.maximum(SPEED * times - fro, 0))
    return LOAD / YOUNG * total


if __name__ == "__main__":
    times = np.linspace(0, 0.01, 101)
    moved = [np.outer(displacement(distance, times), AXIS)
             for distance in (LENGTH, LENGTH / 2)]
    np.savetxt(os.path.join(HERE, "turned.csv"),
               np.column_stack([times, *moved]), delimiter=",", fmt="%.9g",
               comments="", header=",".join(["time [s]"] + [
                   name + axis + " [m]" for name in ("end", "middle")
                   for axis in ("", "_y", "_z")]))
