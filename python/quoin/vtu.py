# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Reads the PVD and VTU files that quoin writes, with numpy only, or in their
place its XDMF files (xdmf.py).

Not a general reader: XML with appended raw data, little endian, 64-bit
block sizes, and one cell type in a file.
"""

import os
import re
import xml.etree.ElementTree as ElementTree

import numpy as np

from quoin.xdmf import Piece, read_xdmf

DTYPES = {"Float64": "<f8", "Int32": "<i4", "UInt8": "u1"}


class Grid:
    """points (n, 2) [m], cells (m, 2 or 3), dictionaries of point and cell
    data, and the time [s]; of blocks in three dimensions points (n, 3) and
    cells (m, 4)."""

    def __init__(self, time, points, cells, point_data, cell_data):
        self.time = time
        self.points = points
        self.cells = cells
        self.point_data = point_data
        self.cell_data = cell_data


def in_plane(points, per_cell):
    """Without the third coordinate, if there is none."""
    return points if per_cell == 4 or points[:, 2].any() else points[:, :2]


def read_vtu(path):
    """The Grid of a file, or of a piece of XDMF."""
    if isinstance(path, Piece):
        time, points, cells, *data = path.read()
        return Grid(time, in_plane(points, cells.shape[1]), cells, *data)
    with open(path, "rb") as file:
        content = file.read()
    mark = re.search(rb"<AppendedData[^>]*>\s*_", content)
    if mark is None:
        raise ValueError(f"{path}: no appended data, so not a file of quoin")
    data = memoryview(content)[mark.end():]
    header = content[: mark.start()] + b"</VTKFile>"
    piece_of = ElementTree.fromstring(header).find("UnstructuredGrid")

    def array(element):
        offset = int(element.get("offset"))
        size = int(np.frombuffer(data, "<u8", 1, offset)[0])
        dtype = np.dtype(DTYPES[element.get("type")])
        values = np.frombuffer(data, dtype, size // dtype.itemsize, offset + 8)
        n = int(element.get("NumberOfComponents"))
        return values.reshape(-1, n) if n > 1 else values

    def arrays(parent):
        return {a.get("Name"): array(a) for a in parent}

    piece = piece_of.find("Piece")
    cells = arrays(piece.find("Cells"))
    n_cells = int(piece.get("NumberOfCells"))
    per_cell = 0 if n_cells == 0 else int(cells["offsets"][0])
    return Grid(
        float(arrays(piece_of.find("FieldData"))["TimeValue"][0]),
        in_plane(array(piece.find("Points")[0]).reshape(-1, 3), per_cell),
        cells["connectivity"].reshape(n_cells, per_cell),
        arrays(piece.find("PointData")),
        arrays(piece.find("CellData")),
    )


def merge(grids):
    """One grid of the pieces of all ranks; empty pieces are left out."""
    grids = [grid for grid in grids if len(grid.cells) > 0]
    if not grids:
        return None
    first = np.cumsum([0] + [len(grid.points) for grid in grids])

    def joined(dictionaries):
        return {
            name: np.concatenate([d[name] for d in dictionaries])
            for name in dictionaries[0]
        }

    return Grid(
        grids[0].time,
        np.concatenate([grid.points for grid in grids]),
        np.concatenate([g.cells + n for g, n in zip(grids, first)]),
        joined([grid.point_data for grid in grids]),
        joined([grid.cell_data for grid in grids]),
    )


def from_the_start(grid):
    """The blocks, joints or bars with displacements and slips from the start of
    the run on, where a stage has reset them; blocks where the mesh has them."""
    data = dict(grid.point_data)
    points = grid.points
    earlier = data.pop("earlier displacement", None)
    if earlier is not None:
        data["displacement"] = data["displacement"] + earlier
        # joints and bars lie where they are now
        if "opening" not in data and "bond slip" not in data:
            points = points - earlier[:, :points.shape[1]]
    slip = data.pop("earlier slip", None)
    if slip is not None:
        data["slip"] = data["slip"] + slip
    return Grid(grid.time, points, grid.cells, data, grid.cell_data)


def xdmf_of(path):
    """The XDMF file in the place of a PVD file."""
    return os.path.splitext(path)[0] + ".xdmf"


def exists(path):
    """Whether there is a series of this name, in either format."""
    return os.path.exists(path) or os.path.exists(xdmf_of(path))


def read_pvd(path):
    """A sorted list of (time, [files of all parts]); of a series in XDMF its
    pieces."""
    if not os.path.exists(path) and exists(path):
        return read_xdmf(xdmf_of(path))
    series = {}
    for record in ElementTree.parse(path).getroot().iter("DataSet"):
        file = os.path.join(os.path.dirname(path), record.get("file"))
        series.setdefault(float(record.get("timestep")), []).append(file)
    return sorted(series.items())


def read_at(path, time=None):
    """The grid of a series nearest to a time, the last one by default; None
    if the series is empty or nothing is in it."""
    series = read_pvd(path)
    if not series:
        return None
    if time is None:
        files = series[-1][1]
    else:
        files = min(series, key=lambda record: abs(record[0] - time))[1]
    return merge([read_vtu(file) for file in files])
