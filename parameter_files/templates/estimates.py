#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The estimates by hand of the templates' READMEs, with the numbers of their
parameter files; writes reference.csv of slope, dam, tunnel and columns. That of
the arch is arch/thrust_line.py."""
import os
from math import pi, radians, sin, tan

HERE = os.path.dirname(os.path.abspath(__file__))
G = 9.81


def wall():
    """Force at which the wall rocks between crushed toes, and at which a course
    slides [N]: the top bears the jack and the slab, the foot the wall as well,
    and both stay horizontal."""
    length, height, thickness, strength, friction = 1.25, 2.0, 0.2, 5e6, 0.6
    top = 150e3 + 2400 * G * 0.25 * length * thickness
    foot = top + 1800 * G * length * height * thickness

    def couple(force):
        return force * (length - force / (0.85 * strength * thickness)) / 2

    return (couple(top) + couple(foot)) / height, friction * top


def slope():
    """Factor of safety of the wedge above the plane: limit equilibrium."""
    height, face, plane = 20, radians(60), radians(35)
    cohesion, friction = 30e3, tan(radians(32))
    weight = 2600 * G * height**2 / 2 * (1 / tan(plane) - 1 / tan(face))
    return (cohesion * height / sin(plane) / (weight * sin(plane))
            + friction / tan(plane))


def dam():
    """Factor of safety against sliding on the foot: mu N / H."""
    weight = 2400 * G * (4 + 24) / 2 * 30
    water = 9810 * 27**2 / 2
    return tan(radians(35)) * weight / water


def tunnel(young):
    """Vertical and horizontal convergence of a hole (Kirsch 1898) [m]."""
    radius, nu, vertical, horizontal = 3, 0.25, 5.2e6, 3.64e6
    mean, half = (vertical + horizontal) / 2, (vertical - horizontal) / 2
    factor = -2 * radius * (1 + nu) / young
    return (factor * (mean + (3 - 4 * nu) * half),
            factor * (mean - (3 - 4 * nu) * half))


def columns():
    """Acceleration at which columns overturn, width by height [g]; and where
    the floor, and what has not rocked, stands after a pulse of 0.19 g [m]."""
    return 0.8 / 4, 0.19 * G / (2 * pi)


def write(name, head, row):
    with open(os.path.join(HERE, name), "w") as stream:
        stream.write(head + "\n" + ",".join("%.6g" % x for x in row) + "\n")


def main():
    print("wall: rocks at %.1f kN, slides at %.1f kN"
          % tuple(x / 1e3 for x in wall()))
    print("columns: %.3f g" % columns()[0])
    write("slope/reference.csv", "sliding [-]", [slope()])
    write("dam/reference.csv", "sliding [-]", [dam()])
    head = "time [s],vertical_convergence [m],horizontal_convergence [m]"
    write("tunnel/reference.csv", head, [0, *tunnel(20e9)])
    write("tunnel/reference_jointed.csv", head, [0, *tunnel(15e9)])
    write("columns/reference.csv", "time [s],beam_x [m]", [0, columns()[1]])


if __name__ == "__main__":
    main()
