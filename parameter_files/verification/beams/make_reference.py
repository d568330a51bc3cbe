#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Beams with closed forms; see README.md.

Vibrations: sums over the modes of Euler and Bernoulli. With mass m by length,
EI the bending stiffness, k_n L the roots of cosh x cos x = -1 (cantilever) or
1 (free), omega_n = k_n^2 sqrt(EI/m) and modes of the mean square 1,

  q_n'' + omega_n^2 q_n = F(t) w_n(x_F) / (m L),  w(x, t) = sum w_n(x) q_n(t),

for the force F (1 - cos a t)/2 up to a given time and constant later.

Strut: a half sine w0 grows to w0 / (1 - P/P_E), P_E = pi^2 EI/L^2.

Elastica: EI theta'' = -P cos theta; with the slope beta at the end and
q = theta, s(q) = integral of dq / sqrt(2 P/EI (sin beta - sin q)).

Hinges: fixed at both ends, under the load w by length beyond w1 = 12 M_p/L^2, with
M_p at the ends and w L^2/8 - M_p in the middle, which goes down by
w1 L^4/(384 EI) + 5 (w - w1) L^4/(384 EI).

Thrust: fixed at its start, on a roller at its end, under the thrust P and w by
length. A rectangle A = b h with the strengths f_c and f_t bears with stress
blocks M_p = h (f_t A + P)(f_c A - P) / (2 A (f_t + f_c)), at its start; in the
middle w L^2/8 - M_p/2, w = 5 w L^4/(384 EI) - M_p L^2/(16 EI). Its fibres have at
the start -P/A and M_p h/(2 I).

Weight: on two supports, w = 5 q L^4/(384 EI), M = q L^2/8 with q = m g.

Pulse: a plate of mass m on springs k on rock of the impedance Z without lateral
strain, which waves leave for good, under the pressure p, all by area:

  m w'' = -p - k (w - u),   Z u' = k (w - u).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LENGTH, BENDING, MASS, FORCE, RISE = 4.0, 30e9 * 8.3333333333e-5, 240.0, 1e3, 0.02


def root(function, low, high):
    for _ in range(200):
        middle = 0.5 * (low + high)
        if function(low) * function(middle) <= 0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def roots(sign, n):
    """Roots of cos x = sign / cosh x, the double one at 0 left out."""
    start = np.arange(n) * np.pi + (0.5 * np.pi if sign < 0 else 1.5 * np.pi)
    return [root(lambda x: np.cos(x) - sign / np.cosh(x), a - 0.5, a + 0.5)
            for a in start]


def mode(x, k, is_cantilever):
    """Of mean square 1; both have the value 2 or -2 at free ends."""
    z, e = k * LENGTH, np.exp
    # sinh and cosh apart from their growing part, which cancels.
    if is_cantilever:
        ratio = (np.sinh(z) - np.sin(z)) / (np.cosh(z) + np.cos(z))
        return (np.cosh(k * x) - np.cos(k * x)
                - ratio * (np.sinh(k * x) - np.sin(k * x)))
    ratio = (np.cosh(z) - np.cos(z)) / (np.sinh(z) - np.sin(z))
    return (np.cosh(k * x) + np.cos(k * x)
            - ratio * (np.sinh(k * x) + np.sin(k * x)))


def response(t, omega, a, end):
    """q of q'' + omega^2 q = (1 - cos a t)/2 until end, then what that is."""
    def during(s):
        d = omega ** 2 - a ** 2
        q = (0.5 * (1 - np.cos(omega * s)) / omega ** 2
             - 0.5 * (np.cos(a * s) - np.cos(omega * s)) / d)
        v = (0.5 * np.sin(omega * s) / omega
             - 0.5 * (omega * np.sin(omega * s) - a * np.sin(a * s)) / d)
        return q, v
    level = 0.5 * (1 - np.cos(a * end))
    q, v = during(end)
    s = t - end
    later = (level / omega ** 2 + (q - level / omega ** 2) * np.cos(omega * s)
             + v / omega * np.sin(omega * s))
    return np.where(t < end, during(t)[0], later)


def vibration(t, x, x_force, is_cantilever):
    a = np.pi / RISE if is_cantilever else 2 * np.pi / RISE
    w = np.zeros_like(t)
    for z in roots(-1 if is_cantilever else 1, 10):
        k = z / LENGTH
        omega = k ** 2 * np.sqrt(BENDING / MASS)
        w += (FORCE / (MASS * LENGTH) * mode(x, k, is_cantilever)
              * mode(x_force, k, is_cantilever) * response(t, omega, a, RISE))
    if is_cantilever:
        return w
    # The rigid motion: the impulse F T/2 of the pulse.
    s = np.minimum(t, RISE)
    path = 0.25 * s ** 2 - 0.5 * (1 - np.cos(a * s)) / a ** 2
    path += 0.5 * RISE * np.maximum(t - RISE, 0.0)
    arm, arm_force = x - 0.5 * LENGTH, x_force - 0.5 * LENGTH
    return w + FORCE / (MASS * LENGTH) * path * (
        1 + 12 * arm * arm_force / LENGTH ** 2)


def strut(share=0.8, initial=1e-3):
    """Further displacement of the middle [m] and moment there [N m]: the load
    pushes the beam up, which turns to the right."""
    force = share * np.pi ** 2 * BENDING / LENGTH ** 2
    whole = initial / (1 - share)
    return whole - initial, -force * whole


def elastica(load):
    """Displacement of the end along and across [m] and moment at the support
    [N m] for the load P L^2/EI."""
    def integrals(beta):
        # q = beta (1 - y^2) takes away the singularity at the end.
        y = (np.arange(4000) + 0.5) / 4000
        q = beta * (1 - y ** 2)
        ds = 2 * beta * y / np.sqrt(2 * load * (np.sin(beta) - np.sin(q))) / 4000
        return ds.sum(), (ds * np.cos(q)).sum(), (ds * np.sin(q)).sum()
    beta = root(lambda b: integrals(b)[0] - 1, 1e-3, 0.5 * np.pi - 1e-6)
    _, along, across = integrals(beta)
    return (-LENGTH * (1 - along), -LENGTH * across,
            -load * BENDING / LENGTH * along)


def hinges(load=937.5, most=1000.0):
    """Displacement of the middle [m] and moments at end and middle [N m]: the
    line turns to the right at the ends, to the left in the middle."""
    first = 12 * most / LENGTH ** 2
    sag = (first + 5 * (load - first)) * LENGTH ** 4 / (384 * BENDING)
    return -sag, -most, load * LENGTH ** 2 / 8 - most


def thrust(area=0.1, depth=0.1, crush=0.2e6, tear=0.05e6, axial=8e3,
           load=200.0):
    most = (depth * (tear * area + axial) * (crush * area - axial)
            / (2 * area * (tear + crush)))
    assert load * LENGTH ** 2 / 8 > most
    sag = (5 * load * LENGTH ** 4 / 384 - most * LENGTH ** 2 / 16) / BENDING
    bent = 0.5 * depth * most / 8.3333333333e-5
    return (-sag, -most, load * LENGTH ** 2 / 8 - most / 2,
            max((bent - axial / area) / tear, (bent + axial / area) / crush))


def pulse(times):
    """Displacements of plate and rock [m], by Runge and Kutta."""
    mass, spring = 2400 * 0.2, 1e10
    impedance = np.sqrt(2500 * 10e9 * 0.75 / (1.25 * 0.5))

    def rate(t, y):
        p = 0.5e5 * (1 - np.cos(1000 * np.pi * t)) if t < 0.002 else 0.0
        pull = spring * (y[0] - y[2])
        return np.array([y[1], (-p - pull) / mass, pull / impedance])
    y, h, rows, t = np.zeros(3), 1e-6, [], 0.0
    for time in times:
        for _ in range(int(round((time - t) / h))):
            a = rate(t, y)
            b = rate(t + h / 2, y + h / 2 * a)
            c = rate(t + h / 2, y + h / 2 * b)
            y = y + h / 6 * (a + 2 * b + 2 * c + rate(t + h, y + h * c))
            t += h
        rows.append((time, y[0], y[2]))
    return rows


def write(name, header, rows):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write(header + "\n")
        for row in rows:
            stream.write(",".join("%.9g" % value for value in row) + "\n")


def main():
    # Known numbers: roots; a tip load P L^2/EI = 1 (Bisshopp and Drucker 1945).
    assert abs(roots(-1, 1)[0] - 1.8751041) < 1e-6
    assert abs(roots(1, 1)[0] - 4.7300407) < 1e-6
    assert abs(elastica(1.0)[1] / LENGTH + 0.30172) < 1e-4
    t = np.arange(0, 0.99, 0.005)
    write("cantilever.csv", "time [s],end [m],middle [m]",
          zip(t, vibration(t, 4.0, 4.0, True), vibration(t, 2.0, 4.0, True)))
    t = np.arange(0, 0.295, 0.002)
    write("free.csv", "time [s],start [m],middle [m],end [m]",
          zip(t, *(vibration(t, x, 0.0, False) for x in (0.0, 2.0, 4.0))))
    write("strut.csv", "time [s],middle [m],moment [N m]", [(1.0, *strut())])
    write("elastica.csv", "time [s],end_x [m],end_y [m],moment [N m]",
          [(1.0, *elastica(5.0))])
    write("hinges.csv",
          "time [s],middle [m],end_moment [N m],middle_moment [N m]",
          [(1.0, *hinges())])
    write("thrust.csv",
          "time [s],middle [m],end_moment [N m],middle_moment [N m],used [-]",
          [(1.0, *thrust())])
    weight = MASS * 9.81
    write("weight.csv", "time [s],middle [m],moment [N m]",
          [(1.0, -5 * weight * LENGTH ** 4 / (384 * BENDING),
            weight * LENGTH ** 2 / 8)])
    write("pulse.csv", "time [s],plate [m],rock [m]",
          pulse(np.arange(0, 0.0039, 4e-5)))


if __name__ == "__main__":
    main()
