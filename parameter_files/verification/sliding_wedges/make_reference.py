#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Factors of safety by limit equilibrium of forces: see README.md."""
import math
import os

GRAVITY = 25e3  # density times g [N/m^3]
TOE, TOP = 5.0, 15.0


def area(points):
    return 0.5 * abs(sum(x * v - u * y for (x, y), (u, v)
                         in zip(points, points[1:] + points[:1])))


def plane(dip=35.0, phi=40.0, cohesion=20e3):
    """F = (c A + W cos(dip) tan(phi)) / (W sin(dip))."""
    crest = 10 + 10 / math.tan(math.radians(60))
    end = 10 + 10 / math.tan(math.radians(dip))
    weight = GRAVITY * area([(10, TOE), (end, TOP), (crest, TOP)])
    length = 10 / math.sin(math.radians(dip))
    s, c = math.sin(math.radians(dip)), math.cos(math.radians(dip))
    return (cohesion * length + weight * c * math.tan(math.radians(phi))) / (
        weight * s)


def crack(dip=35.0, phi=40.0, cohesion=20e3, behind=9.0, head=2.0):
    """Of a block before a crack in which the water stands at a head: thrusts
    U across the plane, from the head at the crack to zero at the toe, and V."""
    crest = 10 + 10 / math.tan(math.radians(60))
    s, c = math.sin(math.radians(dip)), math.cos(math.radians(dip))
    foot = TOE + behind * s / c
    weight = GRAVITY * area([(10, TOE), (10 + behind, foot),
                             (10 + behind, TOP), (crest, TOP)])
    length = behind / c
    uplift, thrust = 9810 * head * length / 2, 9810 * head**2 / 2
    return (cohesion * length
            + (weight * c - uplift - thrust * s) * math.tan(math.radians(phi))
            ) / (weight * s + thrust * c)


def push(factor, weight, dip, mu, pushed, sense):
    """The horizontal force that a block passes on.

    It stands on a plane of that dip with friction mu / factor; pushed: the
    force N on its vertical side, where friction N mu / factor acts upwards
    (sense = 1) or downwards (-1).
    """
    m = mu / factor
    s, c = math.sin(dip), math.cos(dip)
    # balance along x (downhill is -x) and y; R, m R: the plane's reaction
    # x: -s R + m c R + N = 0 for the upper block, which gives N;
    # y:  c R + m s R + sense m N = W
    if pushed is None:
        # N = (s - m c) R into the second
        reaction = weight / (c + m * s + m * (s - m * c))
        return (s - m * c) * reaction
    reaction = (weight - sense * m * pushed) / (c + m * s)
    # what is left over, positive: it slides
    return pushed + (s - m * c) * reaction


def two_planes(phi=35.0):
    low, high = math.radians(15), math.radians(50)
    crest = 10 + 10 / math.tan(math.radians(60))
    corner = (18.0, TOE + 8 * math.tan(low))
    end = (corner[0] + (TOP - corner[1]) / math.tan(high), TOP)
    wedge = GRAVITY * area([corner, end, (18.0, TOP)])
    block = GRAVITY * area([(10, TOE), corner, (18.0, TOP), (crest, TOP)])
    mu = math.tan(math.radians(phi))

    def driving(factor):
        between = push(factor, wedge, high, mu, None, 1)
        return push(factor, block, low, mu, between, -1)

    a, b = 0.5, 5.0  # driving(a) < 0 < driving(b)
    for _ in range(100):
        middle = 0.5 * (a + b)
        if driving(middle) > 0:
            b = middle
        else:
            a = middle
    return a


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, "reference.csv"), "w") as stream:
        stream.write("plane [-],weak_plane [-],two_planes [-],"
                     "weak_planes [-],crack [-],stronger [-]\n"
                     "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n"
                     % (plane(), plane(phi=18.5649, cohesion=8e3),
                        two_planes(), two_planes(phi=19.2961), crack(),
                        plane(phi=60., cohesion=0.)))


if __name__ == "__main__":
    main()
