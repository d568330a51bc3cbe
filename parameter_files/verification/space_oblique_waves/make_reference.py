#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacements by plane waves in rock: in a full space, and in a half-space
with the reflection coefficients of Aki & Richards (2002), their equations 5.26
and 5.31 for displacements at a free surface."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
DENSITY, YOUNG, POISSON = 2500.0, 18e9, 0.25
MU = YOUNG / (2 * (1 + POISSON))
ALPHA = np.sqrt(2 * MU * (1 - POISSON) / (1 - 2 * POISSON) / DENSITY)
BETA = np.sqrt(MU / DENSITY)
PERIOD, VELOCITY = 0.016, 0.05
POINTS = np.array([[12.0, 8.0, -6.0], [10.0, 10.0, 0.0]])


def signal(t):
    """Displacement of the incident wave: the integral of its velocity."""
    t = np.clip(t, 0, PERIOD)
    return VELOCITY * (t / 2 - PERIOD / (4 * np.pi)
                       * np.sin(2 * np.pi * t / PERIOD))


def polarisations(d):
    """Of incident P, SV and SH waves along d."""
    ahead = np.array([d[0], d[1], 0.0])
    ahead = ahead / np.linalg.norm(ahead) if np.linalg.norm(ahead) > 1e-9 \
        else np.array([1.0, 0, 0])
    across = np.cross([0, 0, 1.0], ahead)
    return d, np.cross(across, d), across, ahead


def waves(kind, d, origin, surface):
    """Slownesses, amplitudes and delays of all waves of an incident one."""
    d = np.array(d) / np.linalg.norm(d)
    p, sv, sh, ahead = polarisations(d)
    speed = ALPHA if kind == "P" else BETA
    result = [(d / speed, {"P": p, "SV": sv, "SH": sh}[kind], 0.0)]
    if surface is None:
        return result
    sine = np.hypot(d[0], d[1])
    slowness = sine / speed  # along the surface
    # vertical slownesses; i and j of Aki & Richards
    za = np.sqrt(1 / ALPHA**2 - slowness**2) if kind != "SH" else 0
    zb = np.sqrt(1 / BETA**2 - slowness**2)
    height = surface - origin[2]

    def reflected(z, amplitude):
        s = slowness * ahead - z * np.array([0, 0, 1.0])
        return s, amplitude, (d[2] / speed + z) * height

    if kind == "SH":
        return result + [reflected(zb, sh)]
    a = 1 / BETA**2 - 2 * slowness**2
    bottom = a**2 + 4 * slowness**2 * za * zb
    # z is down in Aki & Richards: unit displacements of the waves that go down
    down = np.array([0, 0, -1.0])
    down_p = ALPHA * (slowness * ahead + za * down)
    # SV moves to the right of its way, seen with z down (their figure 5.5)
    down_s = BETA * (zb * ahead - slowness * down)
    up_s = BETA * (zb * ahead + slowness * down)
    if kind == "P":
        pp = (-a**2 + 4 * slowness**2 * za * zb) / bottom
        ps = 4 * (ALPHA / BETA) * slowness * za * a / bottom
        return result + [reflected(za, pp * down_p), reflected(zb, ps * down_s)]
    sp = 4 * (BETA / ALPHA) * slowness * zb * a / bottom
    ss = (a**2 - 4 * slowness**2 * za * zb) / bottom
    sign = np.sign(up_s @ sv)
    return result + [reflected(za, sign * sp * down_p),
                     reflected(zb, sign * ss * down_s)]


def displacement(parts, x, t):
    total = np.zeros((len(t), 3))
    for kind, d, origin, surface in parts:
        for slowness, amplitude, delay in waves(kind, d, origin, surface):
            total += np.outer(signal(t - slowness @ (x - origin) - delay),
                              amplitude)
    return total


SOUTH, NORTH = np.array([-2.0, -2.0, -18.0]), np.array([-2.0, 22.0, -18.0])
CASES = {
    "p": [("P", (.48, .6, .64), SOUTH, None)],
    "s": [(kind, (.48, -.6, .64), NORTH, None) for kind in ("SV", "SH")],
    "p_surface": [("P", (.48, .36, .8), SOUTH, 0.0)],
    "s_surface": [(kind, (.3, .2, .9), SOUTH, 0.0) for kind in ("SV", "SH")],
}


def main():
    t = np.arange(0, 201) * 2e-4
    for name, parts in CASES.items():
        columns = [t] + list(displacement(parts, POINTS[0], t).T) \
            + list(displacement(parts, POINTS[1], t).T)
        np.savetxt(os.path.join(HERE, "reference_%s.csv" % name),
                   np.transpose(columns), delimiter=",", comments="",
                   header="time [s],ux [m],uy [m],uz [m],sx [m],sy [m],sz [m]",
                   fmt="%.8g")


if __name__ == "__main__":
    main()
