#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes reference.csv: a column fixed at its base under a step load on its
top, damped in proportion to its mass, by its modes; and reference_decay.csv with
the decay of Jin, Wang & Zhang instead, whose static value is 0.8 % lower."""
import os

import numpy as np

E, RHO, LENGTH, LOAD = 30e9, 2000.0, 30.0, 1e6
C = np.sqrt(E / RHO)
DECAY = 40.56 / 2  # half of the damping's rate
HEIGHTS = {"A": 30.0, "B": 20.0, "C": 15.0, "D": 10.0}  # above the rigid block


def displacement(height, t, n_modes=4000, decays=False):
    n = np.arange(n_modes)[:, None]
    w = (n + 0.5) * np.pi * C / LENGTH
    damped = np.sqrt(w**2 - DECAY**2)
    shape = (-1.0)**n * np.sin((n + 0.5) * np.pi * height / LENGTH)
    if decays:
        # the impulse response of each mode times exp(-DECAY t)
        motion = (1 - np.exp(-DECAY * t)
                  * (np.cos(w * t) + DECAY / w * np.sin(w * t)))
        return (-2 * LOAD * C**2 / (E * LENGTH)
                * np.sum(shape * motion / (w**2 + DECAY**2), 0))
    motion = (1 - np.exp(-DECAY * t)
              * (np.cos(damped * t) + DECAY / damped * np.sin(damped * t)))
    return -2 * LOAD * C**2 / (E * LENGTH) * np.sum(shape * motion / w**2, 0)


if __name__ == "__main__":
    t = np.linspace(0, 0.3, 3001)
    here = os.path.dirname(os.path.abspath(__file__))
    # statics
    assert abs(displacement(30.0, np.array([5.0]))[0] + 1e-3) < 1e-6
    for name, decays in (("reference.csv", False),
                         ("reference_decay.csv", True)):
        columns = [displacement(h, t, decays=decays) for h in HEIGHTS.values()]
        with open(os.path.join(here, name), "w") as stream:
            stream.write("time [s],%s\n"
                         % ",".join("%s [m]" % point for point in HEIGHTS))
            for row in zip(t, *columns):
                stream.write(",".join("%.9g" % value for value in row) + "\n")
