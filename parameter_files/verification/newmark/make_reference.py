#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Newmark's sliding block on a base that is shaken horizontally.

The base moves with v(t) to the right, its plane falls to the right by beta.
Along the plane the block has the relative displacement s (positive down it):

    N / m = g cos(beta) + v' sin(beta)
    s''   = g sin(beta) - v' cos(beta) - sign(s') mu N / m

and sticks while friction can hold it. The sign being fixed between two events,
s' and s follow from v and its integral in closed form; the events, where s'
vanishes or friction is exceeded, are found by bisection.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
G, MU = 9.81, np.tan(np.radians(20))
AMPLITUDE, OMEGA, RAMP = 0.9, 2 * np.pi, 1.0    # [m/s], [1/s], [s]
SETTLED, END = 1.0, 6.0                         # first and second stage [s]
SCAN = 1e-4                                     # for events [s]


def velocity(t):
    return AMPLITUDE * np.sin(OMEGA * t) * np.minimum(t / RAMP, 1)


def acceleration(t):
    return AMPLITUDE * (OMEGA * np.cos(OMEGA * t) * np.minimum(t / RAMP, 1)
                        + np.sin(OMEGA * t) / RAMP * (t < RAMP))


def displacement(t):
    def ramped(t):
        return AMPLITUDE / RAMP * (np.sin(OMEGA * t) / OMEGA**2
                                   - t * np.cos(OMEGA * t) / OMEGA)

    early = np.minimum(t, RAMP)
    return ramped(early) - AMPLITUDE / OMEGA * (np.cos(OMEGA * np.maximum(
        t, RAMP)) - np.cos(OMEGA * RAMP))


def bisect(function, a, b):
    """Point between a and b where the function turns from false to true."""
    while b - a > 1e-14:
        middle = (a + b) / 2
        a, b = (a, middle) if function(middle) else (middle, b)
    return b


class Phase:
    """Stick (sign 0) or slip from time t on, with s' = 0 then."""

    def __init__(self, t, s, sign, beta):
        self.t, self.s, self.sign = t, s, sign
        self.c, self.q = np.cos(beta), np.sin(beta)

    def drive(self, t):
        """Required and available friction per mass."""
        a = acceleration(t)
        return (G * self.q - a * self.c, MU * (G * self.c + a * self.q))

    def speed(self, t):
        c0 = G * self.q - self.sign * MU * G * self.c
        c1 = self.c + self.sign * MU * self.q
        return c0 * (t - self.t) - c1 * (velocity(t) - velocity(self.t))

    def slip(self, t):
        if self.sign == 0:
            return self.s + 0 * t
        c0 = G * self.q - self.sign * MU * G * self.c
        c1 = self.c + self.sign * MU * self.q
        h = t - self.t
        return self.s + c0 * h**2 / 2 - c1 * (
            displacement(t) - displacement(self.t) - h * velocity(self.t))

    def ends(self, t):
        """Whether the phase is over by time t."""
        if self.sign == 0:
            need, can = self.drive(t)
            return abs(need) > can
        return self.sign * self.speed(t) < 0

    def following(self):
        """The time of its end and the phase after it."""
        t = self.t + SCAN
        while not self.ends(t):
            t += SCAN
            if t > END:
                return t, None
        end = bisect(self.ends, t - SCAN, t)
        need, can = self.drive(end)
        sign = 0
        if self.sign == 0 or abs(need) > can:
            sign = np.sign(need)
        return end, Phase(end, float(self.slip(end)), sign, np.arctan2(
            self.q, self.c))


def history(beta, times):
    phase, slip, done = Phase(0.0, 0.0, 0, beta), np.zeros_like(times), 0.0
    while phase is not None:
        end, following = phase.following()
        print("  %-5s %.6f to %.6f s"
              % ({0: "stick", 1: "down", -1: "up"}[int(phase.sign)], phase.t,
                 min(end, END)))
        now = (times >= done) & (times <= end)
        slip[now] = phase.slip(times[now])
        done, phase = end, following
    return slip


if __name__ == "__main__":
    times = np.arange(0, END + 1e-9, 0.01)
    for name, beta in (("reference.csv", 0.0), ("reference_slope.csv", 5.0)):
        slip = history(np.radians(beta), times)
        print("slope %g: slip from %.4f to %.4f m, at the end %.4f m"
              % (beta, slip.min(), slip.max(), slip[-1]))
        np.savetxt(os.path.join(HERE, name),
                   np.transpose([SETTLED + times, displacement(times), slip]),
                   delimiter=",", fmt="%.9g", comments="",
                   header="time [s],base_x [m],slip [m]")
