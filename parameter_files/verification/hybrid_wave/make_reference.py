#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes the references: plane waves with Ricker's wavelet, in the full plane and
with what a free surface reflects; the coefficients by solving for a surface without
traction."""
import os

import numpy as np

C1, C2, AMPLITUDE = 3000.0, 3000.0 / np.sqrt(3.0), 1e-5
CENTRE, CORNER = (0.0, 0.0), (3.0, -3.0)


def signal(t):
    a = np.pi * 300.0 * (t - 0.008)
    return AMPLITUDE * (1 - 2 * a**2) * np.exp(-a**2)


def wave(kind, p, up):
    """Polarisation and slowness of a wave with the slowness p along x."""
    c = C1 if kind == "P" else C2
    e = np.sqrt(1 / c**2 - p**2) * (1 if up else -1)
    d = c * np.array([p, e])
    return (d if kind == "P" else np.array([d[1], -d[0]])), np.array([p, e])


def traction(d, s):
    """Traction on the surface, by -mu f'."""
    lam = (C1**2 - 2 * C2**2) / C2**2
    n = np.array([0.0, 1.0])
    return lam * d.dot(s) * n + s.dot(n) * d + d.dot(n) * s


def field(kind, angle, half_plane, place, t):
    p = np.sin(np.radians(angle)) / (C1 if kind == "P" else C2)
    waves = [(1.0,) + wave(kind, p, True)]
    if half_plane:
        down = [wave("P", p, False), wave("SV", p, False)]
        matrix = np.column_stack([traction(*w) for w in down])
        parts = np.linalg.solve(matrix, -traction(*waves[0][1:]))
        waves += [(a,) + w for a, w in zip(parts, down)]
    return sum(np.outer(a * d, signal(t - s.dot(place)))
               for a, d, s in waves)


def write(name, kind, angle, half_plane, corner):
    t = np.linspace(0, 0.016, 401)
    columns = np.vstack([field(kind, angle, half_plane, np.array(place), t)
                         for place in (CENTRE, corner)])
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    with open(path, "w") as stream:
        stream.write("time [s],centre_x [m],centre_y [m],corner_x [m],"
                     "corner_y [m]\n")
        for row in zip(t, *columns):
            stream.write(",".join("%.9g" % value for value in row) + "\n")


write("reference_sv.csv", "SV", 30, False, CORNER)
write("reference_p.csv", "P", -50, False, CORNER)
write("reference_half_plane.csv", "SV", 20, True, (3.0, 0.0))
