# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Runs whose answers are known, written as quoin writes them, and a program
that stands for quoin and copies them."""
import argparse
import json
import os
import sys
import tempfile
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__))))
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, os.path.join(ROOT, "python"))

from quoin import solver_comparison  # noqa: E402
from quoin import vtu  # noqa: E402

SPEC = {"x": {"column": "u", "factor": 1e3, "label": "displacement [mm]"},
        "y": {"label": "force [kN]"},
        "curves": [{"column": "f", "factor": -1e-3}]}
TYPES = {"f": "Float64", "i": "Int32", "u": "UInt8"}
CELL_TYPES = {2: 3, 3: 5, 4: 10}     # of VTK: line, triangle, tetrahedron
PARAMETERS = """subsection Stages
  set Names = settle, push
end
subsection Joints
  set Names = mortar
  subsection mortar
    set Shear stiffness = 1e9
    set Law = Coulomb
    set Peak crushing = 1e-4
  end
end
"""
# Stands for quoin: copies the folder of the solver that is asked for.
QUOIN = """#!/usr/bin/python3
import shutil, sys
words = sys.argv
solver = words[-1].split("=")[1]
if "--set" not in words or not words[-1].startswith("Solver="):
    sys.exit(1)
shutil.copytree("%s/" + solver, words[words.index("--output") + 1],
                dirs_exist_ok=True)
sys.exit({"explicit": 0, "implicit": %d}[solver])
"""


def write_vtu(path, time, points, cells, point_data, cell_data):
    """Writes a VTU file as quoin does: XML with appended raw data."""
    blocks, offset = [], 0

    def array(name, values):
        nonlocal offset
        values = np.ascontiguousarray(values)
        kind = TYPES[values.dtype.kind]
        n = values.shape[1] if values.ndim > 1 else 1
        raw = values.astype(vtu.DTYPES[kind]).tobytes()
        blocks.append(np.uint64(len(raw)).tobytes() + raw)
        text = (f'<DataArray type="{kind}" Name="{name}" format="appended" '
                f'NumberOfComponents="{n}" offset="{offset}"/>')
        offset += len(blocks[-1])
        return text

    def group(name, data):
        return (f"<{name}>" + "".join(array(*item) for item in data.items())
                + f"</{name}>")

    places = np.pad(points, [(0, 0), (0, 3 - points.shape[1])])
    header = (
        '<VTKFile type="UnstructuredGrid" version="1.0" '
        'byte_order="LittleEndian" header_type="UInt64"><UnstructuredGrid>'
        + group("FieldData", {"TimeValue": np.array([time])})
        + f'<Piece NumberOfPoints="{len(points)}" '
        + f'NumberOfCells="{len(cells)}">'
        + group("Points", {"points": places})
        + group("Cells", {
            "connectivity": cells.ravel().astype(np.int32),
            "offsets": (np.arange(1, len(cells) + 1)
                        * cells.shape[1]).astype(np.int32),
            "types": np.full(len(cells), CELL_TYPES[cells.shape[1]],
                             np.uint8)})
        + group("PointData", point_data) + group("CellData", cell_data)
        + '</Piece></UnstructuredGrid><AppendedData encoding="raw">_')
    with open(path, "wb") as file:
        file.write(header.encode() + b"".join(blocks)
                   + b"</AppendedData></VTKFile>")


def joint_grid(opening, slip, order=None, turned=()):
    """Faces of 1 m in a row, 2 m, ..., two values of opening and slip [m]
    each; faces in another @p order, some with their ends @p turned."""
    n = len(opening)
    ends = np.cumsum([0.] + [1. + k for k in range(n)])
    x = np.stack([ends[:-1], ends[1:]], axis=1)
    values = [x, np.array(opening, float), np.array(slip, float)]
    for face in turned:
        for value in values:
            value[face] = value[face, ::-1]
    order = range(n) if order is None else order
    x, opening, slip = (value[list(order)].ravel() for value in values)
    moved = np.stack([0.1 * opening, 0.1 * x, 0. * x], axis=1)
    return vtu.Grid(
        0., np.stack([x, 0. * x], axis=1) + moved[:, :2],
        np.arange(2 * len(order)).reshape(-1, 2),
        {"displacement": moved, "opening": opening, "slip": slip,
         "shear traction": 0. * x, "damage": (opening > 2e-4) * 1.,
         "point state": (opening > 0.).astype(np.uint8),
         "crushing": 0. * x},
        {"length": 1. + np.array(order),
         "joint set": np.zeros(len(order), np.int32),
         "handed over": np.zeros(len(order), np.uint8),
         "state": np.zeros(len(order), np.uint8)})


def write_run(folder, u, f, grids, wall_time=10., finished=True, ends=None):
    """A run whose histories have these rows, a second apart, and fields of
    joints and of one block at the times that @p grids have. @p ends: of its
    stages [s]."""
    os.makedirs(os.path.join(folder, "fields"))
    with open(os.path.join(folder, "histories.csv"), "w") as file:
        file.write("time [s],u [m],f [N]\n")
        file.writelines(f"{k},{a},{b}\n" for k, (a, b) in enumerate(zip(u, f)))
    with open(os.path.join(folder, "summary.json"), "w") as file:
        json.dump({"finished": finished, "steps": len(u),
                   "wall time [s]": wall_time,
                   "energy residual share": 1e-5,
                   "stages": {name: {"time [s]": time}
                              for name, time in (ends or {}).items()}}, file)
    with open(os.path.join(folder, "used_parameters.prm"), "w") as file:
        file.write(PARAMETERS)
    corners = np.array([[0., 0.], [3., 0.], [3., 1.], [0., 1.]])
    zero = np.zeros((4, 3))
    for name in ("joints", "blocks"):
        sets = []
        for time, grid in grids.items():
            path = f"fields/{name}_{time}.vtu"
            sets.append(f'<DataSet timestep="{time}" file="{path}"/>')
            words = ((grid.points, grid.cells, grid.point_data, grid.cell_data)
                     if name == "joints" else
                     (corners, np.array([[0, 1, 2], [0, 2, 3]]),
                      {"displacement": zero, "velocity": zero},
                      {"block": np.zeros(2, np.int32),
                       "material": np.zeros(2, np.int32)}))
            write_vtu(os.path.join(folder, path), float(time), *words)
        with open(os.path.join(folder, name + ".pvd"), "w") as file:
            file.write("<VTKFile><Collection>" + "".join(sets)
                       + "</Collection></VTKFile>")


NOTHING = [[0., 0.], [0., 0.]]
WIDE = [[2e-4, 0.], [0., 3e-4]]
SLID = [[0., 0.], [-2e-4, 0.]]


def program_of_words(doc):
    """The executable that the word --quoin names, which unittest does not
    know."""
    parser = argparse.ArgumentParser(description=doc)
    parser.add_argument("--quoin", required=True, help="the executable")
    options, sys.argv[1:] = parser.parse_known_args()
    return os.path.abspath(options.quoin)


class Scratch(unittest.TestCase):
    """Tests with a folder that goes with them."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name


class Folders(Scratch):
    """An explicit run that settles, peaks at 40 kN and 2 mm and falls, and an
    implicit one that is 10 % lower and ends at 3 mm, in fewer rows."""

    def setUp(self):
        super().setUp()
        self.explicit, self.implicit = (
            os.path.join(self.folder, name)
            for name in solver_comparison.SOLVERS)
        u = 1e-3 * np.array([0., 0., 1., 2., 3., 4.])
        f = -1e3 * np.array([5., 0., 20., 40., 30., 20.])
        write_run(self.explicit, u, f, {
            1: joint_grid(NOTHING, NOTHING), 3: joint_grid(WIDE, SLID),
            4: joint_grid(WIDE, WIDE), 5: joint_grid(WIDE, WIDE)}, 50.)
        write_run(self.implicit, 1e-3 * np.array([0., 2., 3.]),
                  -1e3 * np.array([0., 36., 27.]),
                  {0: joint_grid(NOTHING, NOTHING),
                   1: joint_grid(WIDE, SLID, [1, 0], turned=[0]),
                   2: joint_grid(NOTHING, WIDE)}, finished=False)

    def compare(self, spec=None):
        return solver_comparison.Comparison(
            spec or SPEC, self.folder, self.explicit, self.implicit)

    def quoin(self, status):
        """A program that ends the implicit run with this exit status."""
        path = os.path.join(self.folder, "quoin")
        with open(path, "w") as file:
            file.write(QUOIN % (self.folder, status))
        os.chmod(path, 0o755)
        return path
