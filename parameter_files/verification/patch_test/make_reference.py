#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Uniform stress in an elastic square cut by straight linear joints.

Every joint is a complete straight line, so a uniform stress is compatible:
the strain is uniform in the blocks, and crossing a joint adds the constant
jump n (t_n / kn) + e (t_s / ks) with the traction t = sigma n.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU = 20e9, 0.25
STRESS = np.array([[-100.0, 50.0], [50.0, -300.0]])
JOINTS = {  # ends, kn, ks
    "a": ((0, 0.25), (1, 0.45), 20e9, 10e9),
    "b": ((0, 0.8), (1, 0.3), 30e9, 12e9),
    "c": ((0.35, 1), (1, 0.55), 15e9, 25e9),
}

names, values = ["time [s]"], [0.0]


def add(name, value):
    names.append(name)
    values.append(value)


for cell in "12345":
    for label, value in (("xx", STRESS[0, 0]), ("yy", STRESS[1, 1]),
                         ("xy", STRESS[0, 1])):
        add("s%s_%s [Pa]" % (label, cell), value)

jump = {}
for name, (start, end, kn, ks) in JOINTS.items():
    along = np.subtract(end, start)
    along = along / np.linalg.norm(along)
    # normal from the side below to the side above, tangent (n_y, -n_x)
    edge = along
    normal = np.array([-edge[1], edge[0]])
    traction = STRESS @ normal
    t_n, t_s = traction @ normal, traction @ edge
    add("normal_%s [Pa]" % name, t_n)
    add("shear_%s [Pa]" % name, t_s)
    add("opening_%s [m]" % name, t_n / kn)
    add("slip_%s [m]" % name, t_s / ks)
    jump[name] = normal * t_n / kn + edge * t_s / ks

# plane strain; no strain along x, no rotation of the horizontal base
shear = STRESS[0, 1] * 2 * (1 + NU) / E
vertical = (1 + NU) / E * ((1 - NU) * STRESS[1, 1] - NU * STRESS[0, 0])
horizontal = (1 + NU) / E * ((1 - NU) * STRESS[0, 0] - NU * STRESS[1, 1])
assert abs(horizontal) < 1e-12 * abs(vertical)
corner = np.array([shear, vertical])
for name, crossed in (("left", "ab"), ("right", "abc")):
    u = corner + sum(jump[j] for j in crossed)
    add("ux_%s [m]" % name, u[0])
    add("uy_%s [m]" % name, u[1])

np.savetxt(os.path.join(HERE, "reference.csv"), [values], delimiter=",",
           fmt="%.12g", comments="", header=",".join(names))
