#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Plane waves that dashpots on a plane wall reflect, in three dimensions.

Writes for each wave the velocity of the other sides of the box, WAVE_ANGLE.inc,
and the reference, WAVE_ANGLE.csv. A wave is the real part of A p F(t - s.x) with
F(t) = 1/(1 + i t/T)^5, which has positive frequencies alone: complex amplitudes
and slownesses are those of what is reflected beyond the critical angle.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, E, NU = 2500.0, 25e9, 0.25
C2 = np.sqrt(E / 2 / (1 + NU) / RHO)
C1 = C2 * np.sqrt((2 - 2 * NU) / (1 - 2 * NU))
PERIOD, ARRIVAL, SIZE, POWER = 1e-3, 6.5e-3, 1e-6, 5
END = 0.0105
PLACES = {"wall": (0.0, 0.0, 0.0), "inside": (-0.2, -0.3, -0.6)}
# normal of the wall, from the rock outwards, and two directions in it
N, S, T = np.array([[2, 3, 6], [3, -6, 2], [6, 2, -3]]) / 7
AZIMUTH = np.radians(25)
ALONG = np.cos(AZIMUTH) * S + np.sin(AZIMUTH) * T
ACROSS = np.cross(N, ALONG)
SPEED = {"p": C1, "sv": C2, "sh": C2}
WAVES = [("p", 30), ("p", 60), ("sv", 30), ("sv", 60), ("sh", 30), ("sh", 60)]


def plane_wave(kind, tangential, sense):
    """Slowness and polarisation of a wave of this slowness along the wall, that
    goes to the wall (+1) or back (-1). They are complex where it fades."""
    across = np.sqrt(complex(SPEED[kind]**-2 - tangential**2))
    slowness = sense * across * N + tangential * ALONG
    if kind == "p":
        return slowness, C1 * slowness
    if kind == "sv":
        return slowness, C2 * (sense * across * ALONG - tangential * N)
    return slowness, ACROSS + 0j


def unbalanced(slowness, polarisation):
    """Traction on the wall and of its dashpots, of a wave, over i w."""
    lam = RHO * (C1**2 - 2 * C2**2)
    mu = RHO * C2**2
    stress = -(lam * polarisation @ slowness * np.eye(3)
               + mu * (np.outer(slowness, polarisation)
                       + np.outer(polarisation, slowness)))
    normal = polarisation @ N
    dashpots = RHO * (C1 * normal * N + C2 * (polarisation - normal * N))
    return stress @ N + dashpots


def reflection(kind, degrees):
    """[(amplitude, slowness, polarisation)]: the wave that comes in, the
    reflected P, SV and SH waves."""
    tangential = np.sin(np.radians(degrees)) / SPEED[kind]
    comes = plane_wave(kind, tangential, 1)
    back = [plane_wave(k, tangential, -1) for k in SPEED]
    amplitudes = np.linalg.solve(
        np.column_stack([unbalanced(*wave) for wave in back]),
        -unbalanced(*comes))
    return [(1.0, *comes)] + [(a, *wave) for a, wave in zip(amplitudes, back)]


def displacements(wave, place, times):
    """Those of a wave by SIZE, complex: x, y and z at each time."""
    amplitude, slowness, polarisation = wave
    delay = (times - ARRIVAL - slowness @ np.asarray(place)) / PERIOD
    return np.outer((1 + 1j * delay)**-POWER, amplitude * polarisation)


def expressions(waves):
    """Velocities along x, y and z as functions for parameter files."""
    found = [[], [], []]
    for amplitude, slowness, polarisation in waves:
        if abs(amplitude) < 1e-9:
            continue
        # real and imaginary part of 1 + i (t - s.x)/T
        a = "1" + "".join("%+.10g*%s" % (s / PERIOD, axis) for s, axis in zip(
            slowness.imag, "xyz") if abs(s) > 1e-12)
        b = "(%.10g*(t-%.10g)%s)" % (1 / PERIOD, ARRIVAL, "".join(
            "%+.10g*%s" % (-s / PERIOD, axis)
            for s, axis in zip(slowness.real, "xyz")))
        square, angle = "1+%s^2" % b, "atan(%s)" % b
        if a != "1":
            square, angle = "(%s)^2+%s^2" % (a, b), "atan(%s/(%s))" % (b, a)
        for terms, component in zip(found, polarisation):
            # of the derivative in time
            factor = -1j * POWER / PERIOD * SIZE * amplitude * component
            if abs(factor) > 1e-12 * SIZE / PERIOD:
                terms.append("%.10g*(%s)^(%g)*cos(%d*%s%+.10g)" % (
                    abs(factor), square, -(POWER + 1) / 2, POWER + 1, angle,
                    -np.angle(factor)))
    return [" + ".join(terms) or "0" for terms in found]


def main():
    for kind, degrees in WAVES:
        waves = reflection(kind, degrees)
        print("%-2s %2d: %s" % (kind, degrees, ", ".join(
            "%.4f" % abs(a) for a, _, _ in waves[1:])))
        if kind == "sh":
            cosine = np.cos(np.radians(degrees))
            assert np.allclose([a for a, _, _ in waves[1:]],
                               [0, 0, (cosine - 1) / (cosine + 1)])
        name = os.path.join(HERE, "%s_%d" % (kind, degrees))
        times = np.linspace(0, END, 211)
        moved = [SIZE * sum(displacements(wave, place, times)
                            for wave in waves).real
                 for place in PLACES.values()]
        np.savetxt(name + ".csv", np.column_stack([times, *moved]),
                   delimiter=",", fmt="%.7g", comments="",
                   header=",".join(["time [s]"] + [
                       "%s_%s [m]" % (place, axis) for place in PLACES
                       for axis in "xyz"]))
        with open(name + ".inc", "w") as stream:
            stream.write("# Written by make_reference.py.\n")
            for name, text in zip(("Horizontal", "Lateral", "Vertical"),
                                  expressions(waves)):
                stream.write("set %s = %s\n" % (name, text))


if __name__ == "__main__":
    main()
