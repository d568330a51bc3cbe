#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Collision, throw, stack and slide of named blocks: see README.md."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def write(name, columns, values):
    np.savetxt(os.path.join(HERE, "reference_%s.csv" % name),
               np.transpose(values), delimiter=",", fmt="%.12g", comments="",
               header="time [s]," + columns)


def collision():
    """Free flight, half a wave of two masses on a spring, free flight."""
    m_a, m_b, v_a, v_b, gap, k = 2000.0, 3000.0, 2.0, -1.0, 0.5, 1e7
    mass, mean = m_a + m_b, (m_a * v_a + m_b * v_b) / (m_a + m_b)
    omega = np.sqrt(k * mass / (m_a * m_b))
    speed = v_a - v_b
    t = np.arange(0, 0.4, 1e-3)
    since = t - gap / speed
    touch = np.clip(since, 0, np.pi / omega)       # time in contact
    after = np.maximum(since - np.pi / omega, 0)
    approach = speed * np.cos(omega * touch)
    a_v = mean + m_b / mass * approach
    b_v = mean - m_a / mass * approach
    a_x = (v_a * np.minimum(t, gap / speed) + mean * touch
           + m_b / mass * speed / omega * np.sin(omega * touch)
           + (mean - m_b / mass * speed) * after)
    force = k * speed / omega * np.sin(omega * touch)
    write("collision", "a_x [m],a_v [m/s],b_v [m/s],on_a [N],on_b [N]",
          [t, a_x, a_v, b_v, -force, force])


def thrown():
    """A parabola and a steady spin."""
    t = np.arange(0, 0.99 + 1e-9, 0.01)
    write("thrown", "x [m],y [m],rotation [deg],v_x [m/s],v_y [m/s],"
          "spin [deg/s]",
          [t, 3 * t, 4 * t - 5 * t**2, 720 * t, 3 + 0 * t, 4 - 10 * t,
           720 + 0 * t])


def stack():
    """The weight of what is above, which acts in its centroid."""
    heights, density, gravity = (0.5, 0.75, 0.4), 2000.0, (2.0, -10.0)
    faces = np.concatenate([[0], np.cumsum(heights)])
    centroids = (faces[1:] + faces[:-1]) / 2
    masses = density * np.array(heights)
    row = []
    for block in (0, 1):
        above = slice(block + 1, 3)
        mass = masses[above].sum()
        lever = (masses[above] * centroids[above]).sum() / mass \
            - centroids[block]
        row += [mass * gravity[0], mass * gravity[1],
                -lever * mass * gravity[0]]
    # all forces on the middle block balance its weight
    row += [-masses[1] * gravity[0], -masses[1] * gravity[1], 0.0]
    names = ["%s_%s" % (block, part) for block in ("base", "middle", "all")
             for part in ("x [N]", "y [N]", "m [N m]")]
    write("stack", ",".join(names), [[1.0]] + [[value] for value in row])


def slide():
    """m v' = -tan(phi) N, N = m g f(t)."""
    mass, gravity, friction, ramp = 1000.0, 10.0, np.tan(np.radians(30)), 0.1
    t = np.arange(0, 0.299, 1e-3)
    s = np.minimum(t, ramp)
    f = (1 - np.cos(np.pi * s / ramp)) / 2
    # integral of f, and its integral
    once = s / 2 - ramp / (2 * np.pi) * np.sin(np.pi * s / ramp) + t - s
    twice = (s**2 / 4 + ramp**2 / (2 * np.pi**2)
             * (np.cos(np.pi * s / ramp) - 1) + (t - s) * ramp / 2
             + (t - s)**2 / 2)
    write("slide", "x [m],v [m/s],force_x [N],force_y [N]",
          [t, 2 * t - friction * gravity * twice,
           2 - friction * gravity * once,
           -friction * mass * gravity * f, mass * gravity * f])


if __name__ == "__main__":
    collision()
    thrown()
    stack()
    slide()
