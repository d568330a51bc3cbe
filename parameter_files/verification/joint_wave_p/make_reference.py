#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Plane wave through linear joints, by the method of characteristics.

The wave that leaves a joint upwards is s, downwards r; the one that arrives
from below is a, from above b (all particle velocities). Both sides carry the
same stress, q = s - b = a - r, in units of z = rho c, and the joint of
stiffness k closes by it:

    dq/dt = (2 k / z) (a - b - q)

For one joint and b = 0 this is dv_t/dt = (2 k / z) (v_i - v_t). Several joints
exchange s and r with the travel time between them. The equation is integrated
with a step that divides the travel time, exactly for forcing that is linear
within the step.
"""
import os

import numpy as np


def ricker(t, amplitude, frequency, delay):
    a = (np.pi * frequency * (t - delay)) ** 2
    return amplitude * (1 - 2 * a) * np.exp(-a)


def solve(incident, joints, z, c, k, duration, spacing=20.0, parts=800):
    """Times, and for every joint the velocities s, r and q."""
    dt = spacing / c / parts
    n = int(np.ceil(duration / dt)) + 2
    t = dt * np.arange(n)
    lam = 2 * k / z
    decay = np.exp(-lam * dt)
    # q1 = decay q0 + w0 f0 + w1 f1 for f linear in the step
    w1 = 1 - (1 - decay) / (lam * dt)
    w0 = 1 - decay - w1
    m = len(joints)
    a, b, q = (np.zeros((m, n)) for _ in range(3))
    a[0] = incident(t - joints[0] / c)
    delay = [round((joints[j + 1] - joints[j]) / c / dt) for j in range(m - 1)]
    for i in range(1, n):
        for j in range(m):
            if j > 0 and i >= delay[j - 1]:
                e = i - delay[j - 1]
                a[j, i] = q[j - 1, e] + b[j - 1, e]
            if j < m - 1 and i >= delay[j]:
                e = i - delay[j]
                b[j, i] = a[j + 1, e] - q[j + 1, e]
        f0 = a[:, i - 1] - b[:, i - 1]
        f1 = a[:, i] - b[:, i]
        q[:, i] = decay * q[:, i - 1] + w0 * f0 + w1 * f1
    return t, q + b, a - q, q


def velocity(y, incident, joints, c, t, s, r):
    """Particle velocity at height y, at the times t."""

    def late(values, distance):
        return np.interp(t - distance / c, t, values, left=0.0)

    below = [j for j, yj in enumerate(joints) if yj <= y]
    above = [j for j, yj in enumerate(joints) if yj > y]
    up = late(s[below[-1]], y - joints[below[-1]]) if below \
        else incident(t - y / c)
    down = late(r[above[0]], joints[above[0]] - y) if above else 0.0
    return up + down


def write(folder, normal, rho, c, k, frequency, delay, duration):
    def incident(t):
        return ricker(t, 0.01, frequency, delay)

    z = rho * c
    times = np.arange(0, duration, 2e-4)
    for name, joints in (("reference.csv", [100.0]),
                         ("reference_three.csv", [80.0, 100.0, 120.0])):
        t, *waves, q = solve(incident, joints, z, c, k, duration)
        middle = joints.index(100.0)
        # A wave that moves the lower side up compresses the joint; one that
        # moves it along +x leaves the upper side behind, and slip is positive
        # when the upper side moves along +x: both tractions are -z q.
        columns = [("time [s]", t)]
        for label, y in (("v_below", 40.0), ("v_between", 108.0),
                         ("v_above", 160.0)):
            columns.append((label + " [m/s]",
                            velocity(y, incident, joints, c, t, *waves)))
        columns.append((("opening" if normal else "slip") + " [m]",
                        -z * q[middle] / k))
        columns.append(("traction [Pa]", -z * q[middle]))
        data = [np.interp(times, t, values) for _, values in columns]
        np.savetxt(os.path.join(folder, name), np.transpose(data),
                   delimiter=",", comments="", fmt="%.9g",
                   header=",".join(label for label, _ in columns))


if __name__ == "__main__":
    write(os.path.dirname(os.path.abspath(__file__)), True,
          2650.0, 5830.0, 3.5e9, 50.0, 0.03, 0.12)
