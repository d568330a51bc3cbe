#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A load of the density q(x - V t) on a bar that is at rest at t = 0.

With Q the integral of q, Duhamel's principle and d'Alembert's solution give
the velocity of the infinite bar

    v = [(Q(x + c t) - Q(x - V t)) / (c + V)
         + (Q(x - V t) - Q(x - c t)) / (c - V)] / (2 rho A),

behind the load F / (2 rho c A (1 + M)) and ahead of it, until it passes,
F / (2 rho c A (1 - M)), M = V / c. At rest, held at x = 0, the end moves by the
integral of q x / (E A) over the bar, and the support takes that of q.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DENSITY, E, AREA, LENGTH = 2500.0, 40e9, 0.1, 40.0
C = np.sqrt(E / DENSITY)
WIDTH = 2.0
FORCE = 2 * 1e3 * WIDTH        # on both sides of the bar


def cumulated(s):
    """Share of a load centred at 0 that is left of s."""
    u = np.clip(s / WIDTH, -0.5, 0.5)
    return 0.5 + u + np.sin(2 * np.pi * u) / (2 * np.pi)


def velocity(x, t, start=15.0, speed=2000.0):
    left, load, right = (FORCE * cumulated(x - start + way) for way in
                         (C * t, -speed * t, -C * t))
    return ((left - load) / (C + speed)
            + (load - right) / (C - speed)) / (2 * DENSITY * AREA)


def write(name, header, columns):
    np.savetxt(os.path.join(HERE, name), np.array(columns).T, delimiter=",",
               fmt="%.10g", comments="", header=header)


t = np.arange(0, 301) * 2e-5
write("reference.csv", "time [s],behind [m/s],ahead [m/s]",
      [t, velocity(10.0, t), velocity(25.0, t)])

t = np.arange(0, 101) * 0.01
centre = -1.5 + 30 * t
# the part of the shape that is on the bar, in fine steps of its width
u = (np.arange(20000) + 0.5) / 20000 - 0.5
density = (1 + np.cos(2 * np.pi * u)) / 20000
on_bar = [density * (c + WIDTH * u > 0) for c in centre]
write("slow.csv", "time [s],end [m],reaction [N]",
      [t, [FORCE * np.sum(part * (c + WIDTH * u)) / (E * AREA)
           for part, c in zip(on_bar, centre)],
       [-FORCE * np.sum(part) for part in on_bar]])
