#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes aqueduct.geo: three arches of stepped voussoirs on coursed piers.

Radial joints end on the levels of the spandrel's courses, so that voussoirs
and courses fit without small pieces. Each block is a surface of its own with
its own corners; all are convex.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
N_ARCHES = 3
RADIUS, RING = 2.0, 0.55           # of the intrados, depth of the ring [m]
PIER, PIER_HEIGHT, COURSES = 1.5, 3.6, 6
N_HALF = 6                         # voussoirs beside the keystone
STEPS = 5                          # of them with courses of their own
BLOCK = 0.9                        # usual length of a block [m]
DECK = (0.45, 0.45)                # heights of the courses above the crown
GROUND, GROUND_THICKNESS = 26.0, 1.0   # half length [m]
NODE = 1.0                         # of the ground's mesh [m]

SPRING = PIER_HEIGHT               # level of the springing line
PITCH = 2 * RADIUS + PIER
HALF_LENGTH = (N_ARCHES * 2 * RADIUS + (N_ARCHES + 1) * PIER) / 2
CENTRES = (np.arange(N_ARCHES) - (N_ARCHES - 1) / 2) * PITCH
PIERS = (np.arange(N_ARCHES + 1) - N_ARCHES / 2) * PITCH

# Joint i is at ANGLE[i] from the springing and ends at level LEVEL[i].
ANGLE = np.radians(90.0) * np.arange(N_HALF + 1) / (N_HALF + 0.5)
LEVEL = (RADIUS + RING) * np.sin(ANGLE)
LEVEL[STEPS:] = RADIUS + RING + 0.05
REACH = np.append(RADIUS + RING, LEVEL[1:] / np.tan(ANGLE[1:]))


def rectangle(x0, x1, y0, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def row(x0, x1, y0, y1, shifted):
    """Blocks of a course; a shifted one begins with half a block."""
    n = max(int(round((x1 - x0) / BLOCK)), 1)
    cuts = np.linspace(x0, x1, n + 1)
    if shifted and n > 1:
        half = (cuts[1] - cuts[0]) / 2
        cuts = np.concatenate([[x0], cuts[:-1] + half, [x1]])
    elif shifted and x1 - x0 > 0.8 * BLOCK:
        cuts = np.linspace(x0, x1, 3)
    return [rectangle(a, b, y0, y1) for a, b in zip(cuts, cuts[1:])]


def piers():
    blocks = []
    height = PIER_HEIGHT / COURSES
    for x in PIERS:
        for k in range(COURSES):
            cuts = [x - PIER / 2, x + PIER / 2]
            # two stones, one stone: the joint is off the middle by turns
            if k % 2 == 0:
                cuts.insert(1, x + (0.15 if k % 4 == 0 else -0.15))
            blocks += [rectangle(a, b, k * height, (k + 1) * height)
                       for a, b in zip(cuts, cuts[1:])]
    return blocks


def arch(centre):
    def intrados(i):
        return RADIUS * np.cos(ANGLE[i]), RADIUS * np.sin(ANGLE[i])

    right = []
    for i in range(N_HALF):
        corners = [intrados(i), (REACH[i], LEVEL[i])]
        if LEVEL[i + 1] > LEVEL[i]:
            corners.append((REACH[i], LEVEL[i + 1]))
        right.append(corners + [(REACH[i + 1], LEVEL[i + 1]),
                                intrados(i + 1)])
    x, y = intrados(N_HALF)
    keystone = [(-x, y), (x, y), (REACH[-1], LEVEL[-1]),
                (-REACH[-1], LEVEL[-1])]
    left = [[(-px, py) for px, py in reversed(corners)] for corners in right]
    return [[(centre + px, SPRING + py) for px, py in corners]
            for corners in left + [keystone] + right]


def spandrels():
    blocks = []
    for k in range(STEPS):
        y0, y1 = SPRING + LEVEL[k], SPRING + LEVEL[k + 1]
        ends = [-HALF_LENGTH]
        for centre in CENTRES:
            ends += [centre - REACH[k], centre + REACH[k]]
        ends.append(HALF_LENGTH)
        for x0, x1 in zip(ends[::2], ends[1::2]):
            blocks += row(x0, x1, y0, y1, k % 2 == 1)
    return blocks


def deck():
    blocks, y = [], SPRING + LEVEL[-1]
    for k, height in enumerate(DECK):
        blocks += row(-HALF_LENGTH, HALF_LENGTH, y, y + height, k % 2 == 1)
        y += height
    return blocks


def main():
    blocks = [(b, "pier") for b in piers()]
    blocks += [(b, "arch") for centre in CENTRES for b in arch(centre)]
    blocks += [(b, "spandrel") for b in spandrels() + deck()]
    blocks.append((rectangle(-GROUND, GROUND, -GROUND_THICKNESS, 0),
                   "ground"))
    lines = ["// Written by make_geometry.py: an aqueduct of dry blocks."]
    groups, point = {}, 0
    for surface, (corners, group) in enumerate(blocks, start=1):
        n = len(corners)
        size = NODE if group == "ground" else 10.0
        for k, (x, y) in enumerate(corners, start=1):
            lines.append("Point(%d) = {%.6f, %.6f, 0, %g};"
                         % (point + k, x + 0.0, y, size))
        for k in range(n):
            lines.append("Line(%d) = {%d, %d};"
                         % (point + k + 1, point + k + 1,
                            point + (k + 1) % n + 1))
        lines.append("Curve Loop(%d) = {%d:%d};"
                     % (surface, point + 1, point + n))
        lines.append("Plane Surface(%d) = {%d};" % (surface, surface))
        groups.setdefault(group, []).append(surface)
        point += n
    for group, surfaces in groups.items():
        # surfaces of a group have consecutive numbers
        lines.append('Physical Surface("%s") = {%d:%d};'
                     % (group, surfaces[0], surfaces[-1]))
    with open(os.path.join(HERE, "aqueduct.geo"), "w") as stream:
        stream.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
