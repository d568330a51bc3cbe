#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Velocities after the impacts, and the damped vibrations of decay.prm.

Each line of velocities.csv is a column of histories.csv of impacts.prm: what
its block has after the impact.
"""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
NORMAL = (2 / 7, 3 / 7, 6 / 7)
S = (3 / 7, -6 / 7, 2 / 7)
T = (6 / 7, 2 / 7, -3 / 7)
ALONG = tuple((a + b) / math.sqrt(2) for a, b in zip(S, T))
V0, FRICTION = -1.0, math.tan(math.radians(10))


def vector(name, normal, along=0.0):
    return [("%s_%s" % (name, axis), normal * n + along * d)
            for axis, n, d in zip("xyz", NORMAL, ALONG)]


def pair(name, e, below=1.0):
    """Velocities after V0 of the mass 1 above meets the one below at rest."""
    change = (1 + e) * V0 / (1 + below)
    return (vector(name, V0 - below * change)
            + vector(name + "_below", change))


def rows():
    return (pair("equal_02", 0.2) + pair("equal_05", 0.5)
            + pair("equal_08", 0.8) + pair("heavy", 0.2, below=4)
            + vector("wall", -0.5 * V0)
            # friction of the whole pressure while it slides
            + vector("slides", -0.5 * V0, 1.5 + FRICTION * 1.5 * V0)
            # kn = ks and the same damping: both velocities turn alike
            + vector("sticks", -0.5 * V0, -0.5 * 0.3))


def decay(omega, xi, t):
    """Displacement, of 1 at rest at the time 0."""
    damped = omega * math.sqrt(1 - xi * xi)
    return math.exp(-xi * omega * t) * (
        math.cos(damped * t) + xi * omega / damped * math.sin(damped * t))


def decays():
    """Rows of opening and slip [m], from the end of the pull on."""
    size, begin, stiffness, xi = 1e-3, 0.02, 2e7, 0.1
    angle = math.radians(40)
    along = [math.cos(angle) * a + math.sin(angle) * b for a, b in zip(S, T)]
    # Two free cubes of 2000 kg on one joint; a slab of 400 kg between two,
    # whose dashpots are each those of the slab on one of them.
    normal = math.sqrt(stiffness / 1000)
    shear = math.sqrt(2 * stiffness / 400)
    for i in range(401):
        t = 5e-4 * i
        slip = size * decay(shear, math.sqrt(2) * xi, t)
        yield [begin + t, size * decay(normal, xi, t)] + [
            slip * d for d in along]


if __name__ == "__main__":
    with open(os.path.join(HERE, "velocities.csv"), "w") as out:
        out.write("column,velocity [m/s]\n")
        for name, velocity in rows():
            out.write("%s,%.10g\n" % (name, velocity))
    with open(os.path.join(HERE, "reference.csv"), "w") as out:
        out.write("time [s],opening [m],slip_x [m],slip_y [m],slip_z [m]\n")
        for row in decays():
            out.write(",".join("%.9g" % x for x in row) + "\n")
