#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes the eighth of a hollow sphere of 1 m and 3 m, with the core that is
excavated, as gmsh meshes of tetrahedra in layers about the wall:

  make_mesh.py       layers.msh, layers_mixed.msh, layers_crossed.msh

The sphere is that of a cube whose sides are pushed out: three patches of n by
n hexahedra, m layers of them, each q times as thick as the one before; in the
core a cube and one layer about it. Each hexahedron is cut into five tetrahedra,
one between the four corners of which the sum of indices is even, or crossed:
into 24 between its centre, the centres of its faces and its edges. The centres
of faces on both spheres lie on these. Format 2.2.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
CORE = 0.45                        # edge of the cube in the core [m]
OUTER = 3.0
SIDES = ("x0", "y0", "z0")
# corners of a hexahedron by their indices, its faces in order about them
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
                    [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
FACES = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (3, 2, 6, 7), (0, 3, 7, 4),
         (1, 2, 6, 5)]


class Lattice:
    """Nodes by (i, j, k, l): those of the cube in the core, l = 0, and of its
    three sides away from the origin at the radii of l = 1, 2, ..."""

    def __init__(self, n, m, q):
        self.n, self.m = n, m
        steps = q**np.arange(m)
        self.radii = 1 + (OUTER - 1) * np.concatenate(
            [[0], np.cumsum(steps) / np.sum(steps)])
        self.numbers, self.points, self.even = {}, [], []

    def node(self, i, j, k, l):
        key = (i, j, k, l)
        if key not in self.numbers:
            index = np.array([i, j, k])
            if l == 0:
                point = CORE * index / self.n
            else:
                point = np.tan(np.pi / 4 * index / self.n)
                point *= self.radii[l - 1] / np.linalg.norm(point)
            self.numbers[key] = len(self.points)
            self.points.append(point)
            self.even.append((i + j + k + l) % 2 == 0)
        return self.numbers[key]

    def hexahedra(self):
        """Those of the core, of the rock."""
        core, rock = [], []
        for i, j, k in np.ndindex(self.n, self.n, self.n):
            core.append([self.node(*(corner + [i, j, k]), 0)
                         for corner in CORNERS])
        for axis in range(3):
            for i, j, l in np.ndindex(self.n, self.n, self.m + 1):
                cell = []
                for corner in CORNERS:
                    index = np.roll([self.n, i + corner[0], j + corner[1]],
                                    axis)
                    cell.append(self.node(*index, l + corner[2]))
                (core if l == 0 else rock).append(cell)
        return core, rock


def five(cell, even):
    """Tetrahedra of a hexahedron by its even corners and the odd ones."""
    near = [[b for b in range(8)
             if np.sum(np.abs(CORNERS[a] - CORNERS[b])) == 1] for a in range(8)]
    middle = [a for a in range(8) if even[cell[a]]]
    corners = [[a] + near[a] for a in range(8) if a not in middle]
    return [[cell[a] for a in four] for four in [middle] + corners]


def crossed(cell, points, centres, spheres):
    """The 24 tetrahedra of a hexahedron; adds its centre and its faces'."""
    result = []
    centre = len(points)
    points.append(np.mean([points[a] for a in cell], axis=0))
    for face in FACES:
        nodes = [cell[a] for a in face]
        key = tuple(sorted(nodes))
        if key not in centres:
            point = np.mean([points[a] for a in nodes], axis=0)
            radii = [np.linalg.norm(points[a]) for a in nodes]
            for radius in spheres:
                if np.allclose(radii, radius):
                    point *= radius / np.linalg.norm(point)
            centres[key] = len(points)
            points.append(point)
        for a in range(4):
            result.append([nodes[a], nodes[a - 1], centres[key], centre])
    return result


def outer_faces(cells):
    """Triangles of one tetrahedron alone."""
    faces = np.vstack([np.delete(cells, a, axis=1) for a in range(4)])
    faces, count = np.unique(np.sort(faces, axis=1), axis=0,
                             return_counts=True)
    return faces[count == 1]


def orient(points, cells):
    """Turns tetrahedra whose volume is negative."""
    a, b, c, d = np.moveaxis(points[cells], 1, 0)
    volume = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)
    assert np.min(np.abs(volume)) > 1e-6
    cells[volume < 0, :2] = cells[volume < 0, 1::-1]


def make(n, m, q, is_crossed=False):
    """Points, {name: tetrahedra}, {name: triangles}."""
    lattice = Lattice(n, m, q)
    hexahedra = lattice.hexahedra()
    points, centres, cells = lattice.points, {}, []
    for group in hexahedra:
        cells.append(np.array([
            four for cell in group for four in
            (crossed(cell, points, centres, (1.0, OUTER)) if is_crossed
             else five(cell, lattice.even))]))
    points = np.array(points)
    for four in cells:
        orient(points, four)
    faces = outer_faces(np.vstack(cells))
    groups = {name: faces[np.all(np.abs(points[faces][:, :, axis]) < 1e-9,
                                 axis=1)] for axis, name in enumerate(SIDES)}
    groups["outside"] = faces[np.all(np.linalg.norm(points[faces], axis=2)
                                     > OUTER - 1e-9, axis=1)]
    assert sum(map(len, groups.values())) == len(faces)
    return points, dict(zip(("core", "rock"), cells)), groups


def write(path, points, cells, groups):
    with open(path, "w") as stream:
        stream.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                     "$PhysicalNames\n%d\n" % (len(cells) + len(groups)))
        for dimension, names in ((3, cells), (2, groups)):
            for tag, name in enumerate(names, start=1):
                stream.write('%d %d "%s"\n' % (dimension, tag, name))
        stream.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(points))
        stream.writelines("%d %.10g %.10g %.10g\n" % (k, *point)
                          for k, point in enumerate(points, start=1))
        elements = [(2, tag, triangle) for tag, group in
                    enumerate(groups.values(), start=1) for triangle in group]
        elements += [(4, tag, four) for tag, group in
                     enumerate(cells.values(), start=1) for four in group]
        stream.write("$EndNodes\n$Elements\n%d\n" % len(elements))
        for number, (kind, tag, nodes) in enumerate(elements, start=1):
            stream.write("%d %d 2 %d %d %s\n" % (
                number, kind, tag, tag, " ".join("%d" % (a + 1)
                                                 for a in nodes)))
        stream.write("$EndElements\n")


if __name__ == "__main__":
    for file, arguments in (("layers", (5, 12, 1.15)),
                            ("layers_mixed", (3, 6, 1.35)),
                            ("layers_crossed", (3, 6, 1.35, True))):
        write(os.path.join(HERE, file + ".msh"), *make(*arguments))
