#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacement of the wall of a tunnel along y, radius 1 m, in plane strain in
rock under the stress Sxx, Szz (Kirsch 1898):

  2 G u_r = m + (3 - 4 nu) d cos 2 t,   m = (Sxx + Szz) / 2,
  2 G u_t = -(3 - 4 nu) d sin 2 t,      d = (Sxx - Szz) / 2,

and the stresses around it, with Syy along it before:

  s_r  = m (1 - 1/r^2) + d (1 - 4/r^2 + 3/r^4) cos 2 t,
  s_t  = m (1 + 1/r^2) - d (1 + 3/r^4) cos 2 t,
  s_rt = -d (1 + 2/r^2 - 3/r^4) sin 2 t,
  s_y  = Syy - 4 nu d/r^2 cos 2 t.
"""
import numpy as np

YOUNG, NU, SXX, SYY, SZZ = 10e9, 0.3, -6e6, -4e6, -10e6


def wall(angle):
    """Components x and z at the angles from the axis x [m]."""
    mean, half = (SXX + SZZ) / 2, (SXX - SZZ) / 2
    factor = (1 + NU) / YOUNG
    radial = factor * (mean + (3 - 4 * NU) * half * np.cos(2 * angle))
    along = -factor * (3 - 4 * NU) * half * np.sin(2 * angle)
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([radial * c - along * s, radial * s + along * c], 1)


def stresses(r, angle):
    """Radial, hoop and shear stress and that along the tunnel [Pa]."""
    mean, half = (SXX + SZZ) / 2, (SXX - SZZ) / 2
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    return np.stack([mean * (1 - r**-2) + half * (1 - 4 * r**-2 + 3 * r**-4) * c,
                     mean * (1 + r**-2) - half * (1 + 3 * r**-4) * c,
                     -half * (1 + 2 * r**-2 - 3 * r**-4) * s,
                     SYY - 4 * NU * half * r**-2 * c])


if __name__ == "__main__":
    ends = np.array([0.0, np.pi / 2])
    print("side and crown", wall(ends), stresses(np.ones(2), ends)[1])
