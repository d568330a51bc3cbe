#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes beta_*.geo: a specimen cut by parallel joints at the angle beta."""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT, EDGE, FOOT = 1.0, 2.2, 0.16, (0.45, 0.55)


def clipped(polygon, normal, limit):
    """The part of a polygon where normal . x >= limit."""
    result = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        da, db = np.dot(normal, a) - limit, np.dot(normal, b) - limit
        if da >= 0:
            result.append(a)
        if da * db < 0:
            result.append(tuple(np.add(a, np.subtract(b, a) * da / (da - db))))
    return result


def write(beta, offsets):
    """Joints at the distances @p offsets from the centre, in ascending
    order."""
    normal = np.array([-np.sin(np.radians(beta)), np.cos(np.radians(beta))])
    centre = normal @ (WIDTH / 2, HEIGHT / 2)
    cuts = [-np.inf] + [centre + offset for offset in offsets] + [np.inf]
    corners = [(0, 0), (FOOT[0], 0), (FOOT[1], 0), (WIDTH, 0),
               (WIDTH, HEIGHT), (0, HEIGHT)]
    points, lines, curves, loops = [], {}, {}, []

    def number(point):
        for i, other in enumerate(points):
            if np.hypot(*np.subtract(point, other)) < 1e-9:
                return i + 1
        points.append(point)
        return len(points)

    def curve_of(a, b):
        (xa, ya), (xb, yb) = points[a - 1], points[b - 1]
        middle = (xa + xb) / 2
        if max(ya, yb) < 1e-9:
            return "foot" if FOOT[0] < middle < FOOT[1] else "bottom"
        if min(ya, yb) > HEIGHT - 1e-9:
            return "top"
        if max(xa, xb) < 1e-9:
            return "left"
        return "right" if min(xa, xb) > WIDTH - 1e-9 else "joints"

    for below, above in zip(cuts[:-1], cuts[1:]):
        strip = corners
        if np.isfinite(below):
            strip = clipped(strip, normal, below)
        if np.isfinite(above):
            strip = clipped(strip, -normal, -above)
        numbers = [number(point) for point in strip]
        loop = []
        for a, b in zip(numbers, numbers[1:] + numbers[:1]):
            if (b, a) in lines:
                loop.append(-lines[b, a])
                continue
            lines[a, b] = len(lines) + 1
            loop.append(lines[a, b])
            curves.setdefault(curve_of(a, b), []).append(lines[a, b])
        loops.append(loop)

    with open(os.path.join(HERE, "beta_%g.geo" % beta), "w") as out:
        out.write("// A specimen with joints at %g degrees: written by "
                  "make_geometry.py.\nh = %g;\n" % (beta, EDGE))
        for i, (x, y) in enumerate(points):
            out.write("Point(%d) = {%.12g, %.12g, 0, h};\n" % (i + 1, x, y))
        for (a, b), i in lines.items():
            out.write("Line(%d) = {%d, %d};\n" % (i, a, b))
        for i, loop in enumerate(loops):
            out.write("Curve Loop(%d) = {%s};\nPlane Surface(%d) = {%d};\n"
                      % (i + 1, ", ".join(map(str, loop)), i + 1, i + 1))
        for name, members in curves.items():
            out.write('Physical Curve("%s") = {%s};\n'
                      % (name, ", ".join(map(str, members))))
        out.write('Physical Surface("rock") = {%s};\n'
                  % ", ".join(str(i + 1) for i in range(len(loops))))


for angle in (40, 50, 60):
    write(angle, [-0.1, 0.0, 0.1])
write(85, [-0.2, 0.0, 0.2])
