#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Horizontal acceleration that turns an arch into a four-hinge mechanism.

Virtual work on every mechanism of four hinges at joints, alternately at
intrados and extrados. Every one gives an upper bound; the least is the answer,
because nothing slides and so the kinematic theorem holds.
"""
import itertools
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RADIUS, EMBRACE, NUMBER = 10.0, np.radians(157.5), 7


def turned(v):
    return np.array([-v[1], v[0]])


def crossing(a, b, c, d):
    """Point where the line a-b meets c-d."""
    u, v = b - a, d - c
    return a + u * np.dot(turned(v), c - a) / np.dot(turned(v), u)


def collapse(radius, thickness):
    """Least load factor and the (joint, corner) of its hinges."""
    inner, outer = radius - thickness / 2, radius + thickness / 2
    angles = (np.pi + EMBRACE) / 2 - EMBRACE * np.arange(NUMBER + 1) / NUMBER
    half = EMBRACE / NUMBER / 2
    middle = (angles[1:] + angles[:-1]) / 2
    arm = (2 * np.sin(half) * (outer**3 - inner**3)
           / (3 * half * (outer**2 - inner**2)))
    centres = arm * np.transpose([np.cos(middle), np.sin(middle)])

    best = (np.inf, None)
    for hinges in itertools.combinations(range(NUMBER + 1), 4):
        for first in (0, 1):
            corners = [(first + i) % 2 for i in range(4)]  # 1: extrados
            a, b, c, d = (
                (outer if corner else inner)
                * np.array([np.cos(angles[j]), np.sin(angles[j])])
                for j, corner in zip(hinges, corners))
            # the middle part turns about the point common to both others
            pole = crossing(a, b, d, c)
            spins = [0.0, 1.0, 0.0, 0.0, 0.0]
            spins[2] = np.dot(b - a, b - pole) / np.dot(b - pole, b - pole)
            spins[3] = (spins[2] * np.dot(c - pole, c - d)
                        / np.dot(c - d, c - d))
            # a hinge at the extrados opens below: there the right part turns
            # anticlockwise against the left one
            opening = [(spins[i + 1] - spins[i]) * (1 if corner else -1)
                       for i, corner in enumerate(corners)]
            if min(opening) < 0 < max(opening):
                continue
            sign = 1 if min(opening) >= 0 else -1
            live, lift = 0.0, 0.0
            for k, centre in enumerate(centres):
                part = sum(k >= j for j in hinges)
                pivot = (centre, a, pole, d, centre)[part]
                velocity = sign * spins[part] * turned(centre - pivot)
                live += velocity[0]
                lift += velocity[1]
            if live > 0 and lift / live < best[0]:
                best = (lift / live, list(zip(hinges, corners)))
    return best


def main():
    for name, radius in (("centre line", RADIUS),
                         ("intrados", RADIUS * (1 + 0.15 / 2)),
                         ("extrados", RADIUS * (1 - 0.15 / 2))):
        load, hinges = collapse(radius, 0.15 * RADIUS)
        print("R of the %-12s %.4f g, hinges %s" % (name, load, ", ".join(
            "%d %s" % (j, "extrados" if corner else "intrados")
            for j, corner in hinges)))
    load = collapse(RADIUS, 0.15 * RADIUS)[0]
    np.savetxt(os.path.join(HERE, "reference.csv"), [[load]], fmt="%.5f",
               comments="", header="acceleration [g]")


if __name__ == "__main__":
    main()
