#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Impedance of a rigid strip on an elastic half-plane, relaxed contact.

The traction under the strip |x| < b = 1 is a sum of a_n T_n(x)/sqrt(1 - x^2),
whose Fourier transform is a sum of Bessel functions. The surface's displacement
follows from the half-plane's response to exp(i (w t - k x)) on its surface. It
is tested with the same functions: the coefficients solve a system with integrals
of response times J_m J_n over k. The path of integration passes above the branch
points and the pole of Rayleigh's wave, as damping demands.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DENSITY, YOUNG, POISSON = 2000.0, 50e6, 0.25
HALF_WIDTH = 1.0
SHEAR_MODULUS = YOUNG / (2 * (1 + POISSON))
SPEED = (SHEAR_MODULUS / DENSITY) ** 0.5
ORDERS = 14
FREQUENCIES = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
# where the tail of the integrals begins
LAST = 300.0
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(20)


def pulse(t):
    """The motion of the strip in the case [m]; of the edge, if it rocks."""
    return 2 * (t - 0.02) * np.exp(-(200 * (t - 0.02))**2)


def path(a0):
    """Points k and weights, from 0 over the poles to LAST."""
    corners = [0, 0.8 * a0 + 0.5j, 1.6 * a0 + 0.5j, 2.5 * a0]
    pieces = []
    for start, end in zip(corners[:-1], corners[1:]):
        cuts = np.linspace(start, end, 9)
        pieces += list(zip(cuts[:-1], cuts[1:]))
    cuts = np.linspace(corners[-1], LAST, 200)
    pieces += list(zip(cuts[:-1], cuts[1:]))
    k = np.concatenate([a + (b - a) * (POINTS + 1) / 2 for a, b in pieces])
    w = np.concatenate([(b - a) / 2 * WEIGHTS for a, b in pieces])
    return k, w


def bessel(k):
    """J_n(k), n < ORDERS, by the mean over a period."""
    n_points = 2 * int(LAST) + 200
    t = 2 * np.pi * np.arange(n_points) / n_points
    kernel = np.exp(-1j * np.outer(k, np.sin(t)))
    waves = np.exp(1j * np.outer(t, np.arange(ORDERS)))
    return kernel @ waves / n_points


def impedance(a0, component, order):
    """K/mu, or K/(mu b^2) for order 1, the rotation."""
    k, w = path(a0)
    j = bessel(k)
    g = (1 - 2 * POISSON) / (2 * (1 - POISSON))
    nu1, nu2 = np.sqrt(k**2 - g * a0**2), np.sqrt(k**2 - a0**2)
    rayleigh = (2 * k**2 - a0**2)**2 - 4 * k**2 * nu1 * nu2
    response = -a0**2 * (nu1 if component == "vertical" else nu2) / rayleigh
    n = np.arange(order, ORDERS, 2)
    integrals = np.einsum("k,km,kn->mn", w * response, j[:, n], j[:, n])
    # the mean of J_m J_n beyond LAST, times the static response
    integrals += ((1 - POISSON) / (np.pi * LAST)
                  * np.cos((n[:, None] - n[None, :]) * np.pi / 2))
    matrix = np.pi * (-1j)**n[:, None] * 1j**n[None, :] * integrals
    rhs = np.zeros(len(n))
    rhs[0] = np.pi if order == 0 else np.pi / 2
    a = np.linalg.solve(matrix, rhs)
    return a[0] * (np.pi if order == 0 else np.pi / 2)


MOTIONS = {"vertical": ("vertical", 0), "horizontal": ("horizontal", 0),
           "rocking": ("vertical", 1)}

if __name__ == "__main__":
    rows = []
    for a0 in FREQUENCIES:
        row = [a0]
        for component, order in MOTIONS.values():
            value = impedance(a0, component, order)
            row += [value.real, value.imag]
        rows.append(row)
    np.savetxt(os.path.join(HERE, "impedance.csv"), rows, delimiter=",",
               fmt="%.6g", comments="",
               header="a0 [1]," + ",".join(
                   "%s %s [1]" % (name, part) for name in MOTIONS
                   for part in ("real", "imaginary")))
