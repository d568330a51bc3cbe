# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes polygons as the surfaces of a gmsh geometry, one block each."""
import numpy as np


def on_edge(point, a, b, tolerance):
    along = b - a
    length = np.hypot(*along)
    s = np.dot(point - a, along) / length
    off = abs(along[0] * (point - a)[1] - along[1] * (point - a)[0]) / length
    return off < tolerance and tolerance < s < length - tolerance


class Geometry:
    """Blocks as polygons, meshed with few triangles.

    Blocks added with shared=True share points and lines where they touch, so
    that their meshes match; lines between two of them are the physical curve
    'joint'. Others have points and lines of their own.
    """

    def __init__(self, comment, tolerance=1e-9):
        self.comment, self.tolerance = comment, tolerance
        self.blocks = []

    def add(self, group, polygon, shared=True):
        polygon = np.asarray(polygon, float)
        x, y = polygon.T
        if np.dot(x, np.roll(y, -1)) < np.dot(y, np.roll(x, -1)):
            polygon = polygon[::-1]  # anticlockwise, all of them
        self.blocks.append((group, polygon, shared))

    def write(self, path):
        points, lines, loops = [], [], []
        known_points, known_lines = {}, {}

        def point(position, owner):
            key = (owner, *(int(round(x / self.tolerance / 10))
                            for x in position))
            if key not in known_points:
                points.append(position)
                known_points[key] = len(points)
            return known_points[key]

        def line(a, b):
            if (b, a) in known_lines:
                joints.append(known_lines[b, a])
                return -known_lines[b, a]
            lines.append((a, b))
            known_lines[a, b] = len(lines)
            return len(lines)

        corners = [p for _, polygon, shared in self.blocks if shared
                   for p in polygon]
        joints, groups = [], {}
        for group, polygon, shared in self.blocks:
            loop, owner = [], "shared" if shared else len(loops)
            for a, b in zip(polygon, np.roll(polygon, -1, axis=0)):
                between = [p for p in corners
                           if shared and on_edge(p, a, b, self.tolerance)]
                between.sort(key=lambda p: np.dot(p - a, b - a))
                numbers = []
                for p in [a] + between + [b]:
                    number = point(p, owner)
                    if not numbers or number != numbers[-1]:
                        numbers.append(number)
                loop += [line(p, q) for p, q in zip(numbers, numbers[1:])]
            loops.append(loop)
            groups.setdefault(group, []).append(len(loops))

        with open(path, "w") as out:
            out.write("// %s\n// Written by make_geometry.py.\n"
                      % self.comment)
            # few inner points: the blocks are rigid
            out.write("Mesh.MeshSizeExtendFromBoundary = 0;\n")
            size = max(np.ptp([p[i] for p in points]) for i in range(2))
            for i, p in enumerate(points, 1):
                out.write("Point(%d) = {%.12g, %.12g, 0, %.3g};\n"
                          % (i, p[0], p[1], size))
            for i, ends in enumerate(lines, 1):
                out.write("Line(%d) = {%d, %d};\n" % (i, *ends))
            out.write("Transfinite Curve{1 : %d} = 2;\n" % len(lines))
            for i, loop in enumerate(loops, 1):
                out.write("Curve Loop(%d) = {%s};\nPlane Surface(%d) = {%d};\n"
                          % (i, ", ".join(map(str, loop)), i, i))
            if joints:
                out.write('Physical Curve("joint") = {%s};\n'
                          % ", ".join(map(str, joints)))
            for group, members in groups.items():
                out.write('Physical Surface("%s") = {%s};\n'
                          % (group, ", ".join(map(str, members))))
