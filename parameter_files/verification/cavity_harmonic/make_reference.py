#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Plane harmonic P wave on a cylindrical cavity, by series of wave functions.

The potentials are those of Pao & Mow (1973): the incident wave
exp(i (k1 y - w t)) as a sum of J_n(k1 r) cos(n theta), theta from the direction
of propagation, and outgoing waves H_n(k1 r) cos(n theta), H_n(k2 r)
sin(n theta). For each n two coefficients follow from the traction-free wall.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
POISSON = 0.25
RATIO = (2 * (1 - POISSON) / (1 - 2 * POISSON)) ** 0.5  # c1/c2
ORDERS = 30


def bessel(order, z):
    """J_n(z), by the integral over a period."""
    t = 2 * np.pi * np.arange(400) / 400
    return np.mean(np.cos(order * t - z * np.sin(t)))


def neumann(last, z):
    """Y_0 to Y_last of z, by integrals and upward recurrence."""
    points, weights = np.polynomial.legendre.leggauss(200)
    values = []
    for n in (0, 1):
        t = np.pi / 2 * (points + 1)
        part = np.sum(weights * np.sin(z * np.sin(t) - n * t)) / 2
        # until z sinh t makes the integrand vanish
        end = np.arcsinh(50 / z) + 1
        t = end / 2 * (points + 1)
        part -= np.sum(weights * (np.exp(n * t) + (-1)**n * np.exp(-n * t))
                       * np.exp(-z * np.sinh(t))) * end / 2 / np.pi
        values.append(part)
    for n in range(1, last):
        values.append(2 * n / z * values[-1] - values[-2])
    return values


def functions(z):
    """J_n(z) and H_n(z), n = 0, 1, ..."""
    j = np.array([bessel(n, z) for n in range(ORDERS)])
    return j, j + 1j * np.array(neumann(ORDERS - 1, z))[:ORDERS]


def wall(k1a, degrees):
    """|sigma_tt|/sigma_0, |u_r| and |u_t| by the incident displacement.

    On the wall, at angles from the direction of propagation; k1a = w a/c1.
    """
    theta = np.radians(np.atleast_1d(degrees))
    z1, z2 = k1a, RATIO * k1a
    j1, h1 = functions(z1)
    _, h2 = functions(z2)
    stress = np.zeros(len(theta), dtype=complex)
    radial, tangential = stress.copy(), stress.copy()
    for n in range(ORDERS - 1):
        if abs(h2[n + 1]) > 1e100:
            break

        def derivative(f, z):
            return n / z * f[n] - f[n + 1]

        # on r = a, with 2 mu/a^2 left off: sigma_rr and sigma_rt of the
        # potential f(k1 r) cos(n theta), and of f(k2 r) sin(n theta)
        def p_wave(f):
            d = derivative(f, z1)
            return ((n**2 - z2**2 / 2) * f[n] - z1 * d,
                    n * (f[n] - z1 * d))

        def s_wave(f):
            d = derivative(f, z2)
            return (n * (z2 * d - f[n]),
                    -(n**2 - z2**2 / 2) * f[n] + z2 * d)

        incident = (1 if n == 0 else 2) * 1j**n
        rhs = [-incident * value for value in p_wave(j1)]
        p, s = p_wave(h1), s_wave(h2)
        if n == 0:
            a, b = rhs[0] / p[0], 0.0
        else:
            a, b = np.linalg.solve([[p[0], s[0]], [p[1], s[1]]], rhs)
        total = incident * j1[n] + a * h1[n]
        slope = incident * derivative(j1, z1) + a * derivative(h1, z1)
        cosine, sine = np.cos(n * theta), np.sin(n * theta)
        # sigma_rr = 0: the trace of the stress is the hoop stress
        stress += total * cosine
        radial += (z1 * slope + n * b * h2[n]) * cosine
        tangential += (-n * total - b * z2 * derivative(h2, z2)) * sine
    # the incident wave's displacement is k1 and its stress along the
    # direction of propagation (lambda + 2 mu) k1^2
    stress *= 2 * (1 - 1 / RATIO**2)
    return abs(stress), abs(radial) / z1, abs(tangential) / z1


if __name__ == "__main__":
    rows = [(k1a, wall(k1a, 90)[0][0])
            for k1a in (0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1, 1.5, 2)]
    np.savetxt(os.path.join(HERE, "spectrum.csv"), rows, delimiter=",",
               fmt="%.6g", comments="",
               header="w a/c1 [1],hoop stress [1]")
    angles = np.arange(0, 181, 15)
    for k1a in (0.1, 0.5):
        np.savetxt(os.path.join(HERE, "wall_%g.csv" % k1a),
                   np.transpose([angles, *wall(k1a, angles)]),
                   delimiter=",", fmt="%.6g", comments="",
                   header="angle [deg],hoop stress [1],radial [1],"
                   "tangential [1]")
