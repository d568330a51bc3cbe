#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacement of the wall of a tunnel along y, radius 1 m, in plane strain in
rock under the stress Sxx, Szz (Kirsch 1898):

  2 G u_r = m + (3 - 4 nu) d cos 2 t,   m = (Sxx + Szz) / 2,
  2 G u_t = -(3 - 4 nu) d sin 2 t,      d = (Sxx - Szz) / 2.
"""
import numpy as np

YOUNG, NU, SXX, SZZ = 10e9, 0.25, -10e6, -5e6


def wall(angle):
    """Components x and z at the angles from the axis x [m]."""
    mean, half = (SXX + SZZ) / 2, (SXX - SZZ) / 2
    factor = (1 + NU) / YOUNG
    radial = factor * (mean + (3 - 4 * NU) * half * np.cos(2 * angle))
    along = -factor * (3 - 4 * NU) * half * np.sin(2 * angle)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([radial * c - along * s, radial * s + along * c], 1)


if __name__ == "__main__":
    print("side and crown", wall(np.array([0.0, np.pi / 2])))
