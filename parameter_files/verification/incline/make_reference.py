#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Rigid block, 10 m x 25 m, that turns about its lower corner downhill.

In the frame of the plane (s down it, n normal to it) the corner is at s, the
centre at r = R(theta) (-b/2, h/2) from it, theta anticlockwise. With the
reaction (F, N) at the corner, per unit of mass,

    s'' + (theta'' z x r - theta'^2 r)_s = g sin(beta) f(t) + F
          (theta'' z x r - theta'^2 r)_n = -g cos(beta) + N
                    (b^2 + h^2)/12 theta'' = -r_s N + r_n F

and either s'' = 0 (F within friction) or F = -tan(phi) N sign(s'). f is the
factor by which the part of gravity along the plane is put on. Until the moment
of gravity about the corner turns the block it stands. Runge-Kutta of fourth
order with steps far below the tolerance.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
G, BETA, B, H = 10.0, np.radians(40), 10.0, 25.0
SETTLED = 6.0                # end of the first stage [s]
RAMP = 2.0                   # [s]
INERTIA = (B**2 + H**2) / 12
STEP = 2e-4


def factor(t):
    return (1 - np.cos(np.pi * min(t / RAMP, 1))) / 2


def accelerations(t, state, friction):
    """s'', theta''; standing flat and turning about the corner."""
    s, theta, v, w = state
    c, q = np.cos(theta), np.sin(theta)
    rs, rn = -c * B / 2 - q * H / 2, -q * B / 2 + c * H / 2
    gs, gn = G * np.sin(BETA) * factor(t), -G * np.cos(BETA)
    # stick: moment about the corner
    a = (rs * gn - rn * gs) / (INERTIA + B**2 / 4 + H**2 / 4)
    flat = theta == 0 and w == 0
    if flat and a >= 0:
        a = 0.0
    f = -a * rn - w**2 * rs - gs
    n = a * rs - w**2 * rn - gn
    if v == 0 and abs(f) <= friction * n:
        return 0.0, a
    # slip: f = mu n, unknowns n and a
    mu = -friction * np.sign(v if v != 0 else gs)
    coupling = (-rs + rn * mu) / INERTIA          # a = coupling n
    n = (-w**2 * rn - gn) / (1 - coupling * rs)
    a = coupling * n
    if flat and a >= 0:
        return gs + mu * -gn, 0.0
    return gs + mu * n + a * rn + w**2 * rs, a


def integrate(phi, end):
    friction = np.tan(np.radians(phi))
    state, t, rows = np.zeros(4), 0.0, []

    def rate(t, state):
        return np.array([state[2], state[3],
                         *accelerations(t, state, friction)])

    while t < end + STEP / 2:
        rows.append((t, *state))
        k1 = rate(t, state)
        k2 = rate(t + STEP / 2, state + STEP / 2 * k1)
        k3 = rate(t + STEP / 2, state + STEP / 2 * k2)
        k4 = rate(t + STEP, state + STEP * k3)
        # a slip that begins or a turn that begins does so at a step
        if not (k1[2:].any() or state.any()):
            k2 = k3 = k4 = k1
        state = state + STEP / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        t += STEP
    return np.array(rows)


def initial_rates(phi):
    """theta'' and the corner's acceleration under the full gravity."""
    mu = np.tan(np.radians(phi))
    n = (G * np.cos(BETA)
         / (1 - 3 * B * (H * mu - B) / (B**2 + H**2)))
    turn = 6 * n * (H * mu - B) / (B**2 + H**2)
    return -turn, G * np.sin(BETA) - mu * n - turn * H / 2


if __name__ == "__main__":
    for name, phi, end in (("topples", 40.1, 3.6), ("slides_topples", 24, 4)):
        rows = integrate(phi, end)
        print("%-15s phi %.1f: at %.1f s rotation %.3f deg, corner %.4f m"
              % (name, phi, rows[-1, 0], np.degrees(rows[-1, 2]),
                 rows[-1, 1]))
        rows = rows[::50]
        s = rows[:, 1]
        np.savetxt(os.path.join(HERE, "reference_%s.csv" % name),
                   np.transpose([SETTLED + rows[:, 0], s * np.cos(BETA),
                                 -s * np.sin(BETA), np.degrees(rows[:, 2])]),
                   delimiter=",", fmt="%.9g", comments="",
                   header="time [s],corner_x [m],corner_y [m],rotation [deg]")
    print("under the full gravity at once, phi 24: theta'' %.5f /s^2, corner "
          "%.4f m/s^2" % initial_rates(24))
