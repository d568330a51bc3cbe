#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Writes slice_crossed.msh: a slice of 1 m of 8 by 4 m of the ground beside the
axis of the footing, cubes of 1 m that are crossed, 24 tetrahedra each between
centre, centres of faces and edges. Format 2.2.
"""
import importlib.util
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LENGTHS = (8, 1, 4)


def sphere_meshes():
    """The module that crosses the hexahedra of spheres."""
    spec = importlib.util.spec_from_file_location("meshes", os.path.join(
        HERE, "..", "space_sphere", "make_mesh.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def main():
    meshes = sphere_meshes()
    shape = tuple(n + 1 for n in LENGTHS)
    points = [np.array(index, dtype=float) - [0, 0, LENGTHS[2]]
              for index in np.ndindex(shape)]
    centres, cells = {}, []
    for index in np.ndindex(LENGTHS):
        cell = [np.ravel_multi_index(index + corner, shape)
                for corner in meshes.CORNERS]
        cells += meshes.crossed(cell, points, centres, ())
    points, cells = np.array(points), np.array(cells)
    meshes.orient(points, cells)
    faces = meshes.outer_faces(cells)
    x = points[faces]

    def on(axis, value):
        return np.all(np.abs(x[:, :, axis] - value) < 1e-9, axis=1)
    footing = on(2, 0) & np.all(x[:, :, 0] < 2 + 1e-9, axis=1)
    meshes.write(os.path.join(HERE, "slice_crossed.msh"), points,
                 {"clay": cells},
                 {"bottom": faces[on(2, -LENGTHS[2])],
                  "footing": faces[footing],
                  "axis": faces[on(0, 0)], "far": faces[on(0, LENGTHS[0])],
                  "slice": faces[on(1, 0) | on(1, LENGTHS[1])]})


if __name__ == "__main__":
    main()
