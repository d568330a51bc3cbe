#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes the references: plane waves with Ricker's wavelet, in the full plane and
with what a free surface reflects, the coefficients by solving for a surface without
traction; and a Rayleigh wave with this vertical displacement of the surface."""
import os

import numpy as np

C1, C2, AMPLITUDE = 3000.0, 3000.0 / np.sqrt(3.0), 1e-5
CENTRE, CORNER = (0.0, 0.0), (3.0, -3.0)


def signal(t, frequency=300.0, delay=0.008):
    a = np.pi * frequency * (t - delay)
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


def rayleigh_slowness():
    """Root of (2 p^2 - q2)^2 = 4 p^2 g1 g2 by bisection."""
    q1, q2 = C1**-2, C2**-2
    low, high = 1.0001 / C2, 1.3 / C2
    for _ in range(200):
        p = (low + high) / 2
        excess = ((2 * p * p - q2)**2
                  - 4 * p * p * np.sqrt((p * p - q1) * (p * p - q2)))
        low, high = (p, high) if excess > 0 else (low, p)
    return p


def write_rayleigh(name, frequency, delay, end):
    """Frequency by frequency: P and SV parts that decay with depth, of which the
    horizontal displacement is a quarter of a period off."""
    n, step = 2**14, 1e-5
    spectrum = np.fft.rfft(signal(np.arange(n) * step, frequency, delay))
    omega = 2 * np.pi * np.fft.rfftfreq(n, step)
    p, q1, q2 = rayleigh_slowness(), C1**-2, C2**-2
    g1, g2 = np.sqrt(p * p - q1), np.sqrt(p * p - q2)
    a = (2 * p * p - q2) / q2
    columns = []
    for x, y in ((0, 0), (3, 0), (0, -1.5)):
        of_p, of_s = np.exp(omega * g1 * y), np.exp(omega * g2 * y)
        across = -a * of_p + 2 * p * p / q2 * of_s
        along = 1j * p * (a / g1 * of_p - 2 * g2 / q2 * of_s)
        for part in (along, across):
            shifted = spectrum * part * np.exp(-1j * omega * p * x)
            columns.append(np.fft.irfft(shifted, n)[::10])
    del columns[4]  # along in depth: hardly any
    rows = [row for row in np.transpose([np.arange(n)[::10] * step] + columns)
            if row[0] <= end + step]
    np.savetxt(os.path.join(os.path.dirname(os.path.abspath(__file__)), name),
               rows, delimiter=",", fmt="%.9g", comments="",
               header="time [s],centre_x [m],centre_y [m],corner_x [m],"
                      "corner_y [m],deep_y [m]")


write_rayleigh("reference_rayleigh.csv", 100.0, 0.045, 0.07)
