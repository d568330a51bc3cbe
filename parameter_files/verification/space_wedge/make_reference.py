#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Limit equilibrium of a wedge on two planes.

R_A n_A + R_B n_B - T l = W z with the upward normals and the line of
intersection l, downwards; without cohesion it slides where T = (R_A + R_B) tan(phi),
with cohesion its factor of safety is (c A + (R_A + R_B) tan(phi)) / T with the
area A of both planes. With two strengths and water, whose pressure on the planes
adds up to U_A and U_B, it is (c_A A_A + c_B A_B + (R_A - U_A) tan(phi_A)
+ (R_B - U_B) tan(phi_B)) / T (Hoek & Bray 1974, 1981). Pushed off one plane it
slides on the other: tan(phi) by that of the angle between force and normal.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
# pushed off plane b, which would have to pull
PUSHED = np.array([-0.3, -0.35, -1.0])
DENSITY, GRAVITY, WATER = 2600.0, 9.81, 9810.0


def normal(dip, direction):
    dip, direction = np.radians([dip, direction])
    return np.array([np.sin(dip) * np.sin(direction),
                     np.sin(dip) * np.cos(direction), np.cos(dip)])


a, b = normal(40, 130), normal(60, 220)
line = np.cross(a, b)
line *= -np.sign(line[2]) / np.linalg.norm(line)

# the wedge of wedge.geo: 2 m of the line and 1.5 m along the level of each plane
up = -2 * line
level_a = np.array([np.cos(np.radians(130)), -np.sin(np.radians(130)), 0])
level_b = np.array([np.cos(np.radians(220)), -np.sin(np.radians(220)), 0])
level_a *= 1.5 * np.sign(level_a @ b)
level_b *= 1.5 * np.sign(level_b @ a)
area_a = 0.5 * np.linalg.norm(np.cross(up, level_a))
area_b = 0.5 * np.linalg.norm(np.cross(up, level_b))
weight = (DENSITY * GRAVITY / 6
          * abs(up @ np.cross(up + level_a, up + level_b)))


def on_both(force):
    """Friction angle [deg] and the normal forces under a force that is a vector.
    """
    on_a, on_b, along = np.linalg.solve(np.transpose([a, b, -line]), -force)
    return np.degrees(np.arctan(along / (on_a + on_b))), on_a, on_b


def on_one(force, plane):
    across = -force @ plane
    return np.degrees(np.arctan(np.linalg.norm(force + across * plane)
                                / across))


def factor(cohesion, degrees, water=0.0):
    """Factor of safety; cohesions and friction angles of a and b. The water's
    pressure is a pyramid on each plane: 0 at the edges where the plane comes out,
    and in the middle of the line "water" times the depth there below the crest,
    a third of which is its mean."""
    on_a, on_b, along = np.linalg.solve(np.transpose([a, b, -line]),
                                        [0, 0, weight])
    mean = water * WATER * 0.5 * up[2] / 3
    strength = sum(c * area + (on - mean * area) * np.tan(np.radians(phi))
                   for c, phi, on, area in zip(cohesion, degrees,
                                               (on_a, on_b), (area_a, area_b)))
    return strength / along


def main():
    friction, on_a, on_b = on_both(np.array([0, 0, -1.0]))
    assert on_both(PUSHED)[2] < 0
    np.savetxt(os.path.join(HERE, "reference.csv"),
               [[friction, on_a, on_b, on_one(PUSHED, a)]],
               delimiter=",", fmt="%.6g", comments="",
               header="friction angle [deg],normal force on a [-],"
               "normal force on b [-],pushed off b [deg]")
    np.savetxt(os.path.join(HERE, "reference_safety.csv"),
               [[factor((2e3, 2e3), (40, 40)), factor((0, 0), (40, 40)),
                 factor((1e3, 1.5e3), (50, 35), 0.5),
                 np.tan(np.radians(50))
                 / np.tan(np.radians(on_one(PUSHED, a)))]],
               delimiter=",", fmt="%.6g", comments="",
               header="cohesive [-],frictional [-],two strengths and water [-],"
               "pushed off b [-]")


if __name__ == "__main__":
    main()
