#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Fields in XDMF are those in VTU files, bit by bit, on 1, 2 and 3 ranks.

Each case is run once with each format, and every array of every rank and time
is compared; the XDMF is read here, by nothing but its own description. Blocks
that come and go change the mesh, contacts come and go, and a rank may have
none. What does not change must be written once.

Joints that were handed over to contacts stay among the joints: their opening
and slip must be those of the two outlines that met there, which are followed by
the displacements of the blocks alone.
"""
import os
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common  # noqa: E402
from common import Failure  # noqa: E402

sys.path.insert(0, os.path.join(common.ROOT, "python"))
from quoin import results, vtu  # noqa: E402

CAVITY = os.path.join(common.VERIFICATION, "cavity_step", "case.prm")
SPACE = os.path.join(common.VERIFICATION, "space_waves", "s.prm")
INCLINE = os.path.join(common.VERIFICATION, "space_incline", "case.prm")
# name: parameter file, overrides, ranks, series
CASES = {
    "sled": (common.SLED, ["Output/Field interval=5e-3"], 1,
             ("blocks", "joints", "contacts")),
    "sled on 2 ranks": (common.SLED, ["Output/Field interval=5e-3"], 2,
                        ("blocks", "joints", "contacts")),
    "sled on 3 ranks": (common.SLED, ["Output/Field interval=5e-3"], 3,
                        ("blocks", "joints", "contacts")),
    "fill on 2 ranks": (common.FILL,
                        common.SHORT_FILL + ["Output/Field interval=5e-3"], 2,
                        ("blocks", "joints")),
    "cavity": (CAVITY, ["Boundary elements/Duration=0.05",
                        "Sampled field/Spacing=2",
                        "Output/Field interval=5e-3",
                        "Boundary elements/Passivity frequencies=0"], 1,
               ("boundary", "field")),
    "space on 2 ranks": (SPACE, [], 2, ("blocks", "joints")),
    "joints in space on 2 ranks": (INCLINE, ["Output/Field interval=0.1"], 2,
                                   ("blocks", "joints")),
}
KINDS = {("Float", "8"): "<f8", ("Int", "4"): "<i4", ("UChar", "1"): "u1"}


def read_item(folder, element):
    """An array, and where it begins."""
    item = element.find("DataItem")
    if (item.get("Format"), item.get("Endian")) != ("Binary", "Little"):
        raise Failure("an array is not raw and little endian")
    shape = [int(n) for n in item.get("Dimensions").split()]
    kind = np.dtype(KINDS[item.get("NumberType"), item.get("Precision")])
    begin, n = int(item.get("Seek")), int(np.prod(shape)) * kind.itemsize
    with open(os.path.join(folder, item.text), "rb") as stream:
        stream.seek(begin)
        data = stream.read(n)
    if len(data) != n:
        raise Failure("%s ends within an array" % item.text)
    return np.frombuffer(data, kind).reshape(shape), begin


def read_xdmf(path):
    """A list of (time, [pieces]), a piece as {name: array}, and all places in
    which there are cells of the mesh."""
    root = ElementTree.parse(path).getroot()
    series = root.find("Domain/Grid[@CollectionType='Temporal']")
    folder, steps, meshes = os.path.dirname(path), [], set()
    for step in series.findall("Grid[@CollectionType='Spatial']"):
        pieces = []
        for grid in step.findall("Grid[@GridType='Uniform']"):
            cells, begin = read_item(folder, grid.find("Topology"))
            meshes.add(begin)
            piece = {"cells": cells,
                     "points": read_item(folder, grid.find("Geometry"))[0]}
            if len(cells) != int(grid.find("Topology")
                                 .get("NumberOfElements")):
                raise Failure("%s: numbers of elements differ" % path)
            for field in grid.findall("Attribute"):
                piece[field.get("Center"), field.get("Name")] = read_item(
                    folder, field)[0]
            pieces.append(piece)
        steps.append((float(step.find("Time").get("Value")), pieces))
    return steps, meshes


def pieces_of(files):
    """Pieces of VTU files, of ranks that have cells."""
    for file in files:
        grid = vtu.read_vtu(file)
        if len(grid.cells) == 0:
            continue
        points = np.zeros((len(grid.points), 3))
        points[:, :grid.points.shape[1]] = grid.points
        yield {"cells": grid.cells, "points": points,
               **{("Node", name): v for name, v in grid.point_data.items()},
               **{("Cell", name): v for name, v in grid.cell_data.items()}}


def compare_series(what, one, other):
    """The number of arrays that were compared, and of meshes."""
    steps, meshes = read_xdmf(other)
    expected = vtu.read_pvd(one)
    if [time for time, _ in steps] != [time for time, _ in expected]:
        raise Failure("%s: times are not the same" % what)
    n = 0
    for (time, pieces), (_, files) in zip(steps, expected):
        wanted = list(pieces_of(files))
        if len(wanted) != len(pieces):
            raise Failure("%s at %g: %d pieces instead of %d"
                          % (what, time, len(pieces), len(wanted)))
        for piece, right in zip(pieces, wanted):
            if set(piece) != set(right):
                raise Failure("%s at %g: fields %s" % (
                    what, time, set(piece) ^ set(right)))
            for name, values in right.items():
                mine = piece[name]
                if (mine.dtype != values.dtype or mine.shape != values.shape
                        or mine.tobytes() != values.tobytes()):
                    raise Failure("%s at %g: '%s' differs"
                                  % (what, time, name))
                n += 1
    return n, len(meshes)


def compare_results(what, one, other):
    """Compares what the package reads of both runs."""
    mine, right = results.read(other), results.read(one)
    if mine.series() != right.series():
        raise Failure("%s: series are %s" % (what, mine.series()))
    for series in mine.series():
        if list(mine.times(series)) != list(right.times(series)):
            raise Failure("%s: times of %s differ" % (what, series))
        a, b = mine.fields(series), right.fields(series)
        if a is None and b is None:  # a model without joints
            continue
        if not all(np.array_equal(getattr(a, part), getattr(b, part))
                   for part in ("time", "points", "cells")) or not all(
                np.array_equal(values, mine.field(name, None, series))
                for name, values in {**b.point_data, **b.cell_data}.items()):
            raise Failure("%s: the package reads other %s" % (what, series))


def directed_outline(blocks):
    """Edges that belong to one cell only, (n, 2), each with its block on the
    left."""
    c = blocks.cells
    (a, b), third = (blocks.points[c[:, k]] for k in (0, 1)), c[:, 2]
    way, back = b - a, blocks.points[third] - a
    is_left = way[:, 0] * back[:, 1] > way[:, 1] * back[:, 0]
    c = np.where(is_left[:, None], c, c[:, ::-1])
    edges = np.concatenate([c[:, [0, 1]], c[:, [1, 2]], c[:, [2, 0]]])
    _, first, count = np.unique(np.sort(edges), axis=0, return_index=True,
                                return_counts=True)
    return edges[first[count == 1]]


def follow(joints, blocks):
    """Opening and slip of both ends of each face, (n, 2), by the edges of the
    outlines that met there, across and along the mean of both."""
    edges = directed_outline(blocks)
    place = {tuple(ends): edge for edge, ends in zip(
        edges, np.round(blocks.points[edges].reshape(-1, 4), 6))}
    x = blocks.points + blocks.point_data["displacement"][:, :2]
    reference = joints.points - joints.point_data["displacement"][:, :2]
    opening, slip = [], []
    for ends in np.round(reference[joints.cells], 6) + 0.0:
        # as it is drawn the lower side is on the right of a face
        upper = x[place[tuple(ends.ravel())]]
        lower = x[place[tuple(ends[::-1].ravel())][::-1]]
        way = (upper[1] - upper[0]) + (lower[1] - lower[0])
        way /= np.linalg.norm(way)
        gap = upper - lower
        opening.append(gap[:, 1] * way[0] - gap[:, 0] * way[1])
        slip.append(gap @ way)
    return np.array(opening), np.array(slip)


def check_handed_over(output):
    """The largest error of opening and slip by the largest of them, over all
    times, and the number of faces that were handed over in the end."""
    error, largest, n, n_faces = 0.0, 0.0, 0, set()
    for time, files in vtu.read_pvd(os.path.join(output, "joints.pvd")):
        joints = vtu.merge(map(vtu.read_vtu, files))
        blocks = vtu.read_at(os.path.join(output, "blocks.pvd"), time)
        is_over = joints.cell_data["handed over"] != 0
        n_faces.add(len(is_over))
        if np.count_nonzero(is_over) < n:
            raise Failure("%s: fewer faces are handed over at %g s than before"
                          % (output, time))
        n = np.count_nonzero(is_over)
        found = [joints.point_data[name][joints.cells]
                 for name in ("opening", "slip")]
        for mine, right in zip(found, follow(joints, blocks)):
            error = max(error, np.abs(mine - right).max())
            largest = max(largest, np.abs(right).max())
        state = joints.cell_data["state"]
        if np.any(state[is_over] < 2):
            raise Failure("%s: a face that was handed over seems whole"
                          % output)
        for name in ("normal traction", "shear traction"):
            if np.any(joints.point_data[name][joints.cells[is_over]]):
                raise Failure("%s: a face that was handed over has a %s"
                              % (output, name))
    if n == 0 or len(n_faces) != 1:
        raise Failure("%s: no joint was handed over, or faces vanish" % output)
    return error / largest, n


def run_case(options, name):
    """The number of arrays that were compared, and the largest error of joints
    that were handed over."""
    prm, sets, ranks, series = CASES[name]
    worst = 0.0
    with tempfile.TemporaryDirectory(prefix="quoin_") as scratch:
        folders = {}
        for form in ("vtu", "xdmf"):
            folders[form] = os.path.join(scratch, form)
            common.run(options.quoin, prm, folders[form],
                       sets + ["Output/Field format=" + form], ranks)
        n = 0
        for one in series:
            compared, meshes = compare_series(
                "%s, %s" % (name, one),
                os.path.join(folders["vtu"], one + ".pvd"),
                os.path.join(folders["xdmf"], one + ".xdmf"))
            n += compared
            if one == "blocks" and "fill" not in name and meshes > ranks:
                raise Failure("%s: the mesh was written again" % name)
            if one == "blocks" and "fill" in name and meshes <= ranks:
                raise Failure("%s: the mesh does not change" % name)
        compare_results(name, folders["vtu"], folders["xdmf"])
        if set(files_of(folders["xdmf"])) != {
                one + end for one in series for end in (".xdmf", ".bin")}:
            raise Failure("%s has the files %s" % (
                name, ", ".join(files_of(folders["xdmf"]))))
        if "contacts" in series:
            worst, handed_over = check_handed_over(folders["vtu"])
            print("  %s: %d faces handed over, error %.1e"
                  % (name, handed_over, worst), flush=True)
            if worst > 1e-12:
                raise Failure("%s: opening and slip differ by %.1e from those "
                              "of the blocks" % (name, worst))
    print("  %s: %d arrays are the same" % (name, n), flush=True)
    return n, worst


def files_of(folder):
    """Files of fields, in a folder without VTU files."""
    return [name for name in os.listdir(folder)
            if name.endswith((".xdmf", ".bin", ".pvd")) or name == "fields"]


def body():
    parser = common.arguments(__doc__.splitlines()[0])
    parser.add_argument("--only", help="the case whose name begins so")
    options = parser.parse_args()
    if not options.only:
        folder = common.begin(options, "field_formats")
    start = time.monotonic()
    found = common.in_parallel(
        lambda name: run_case(options, name),
        [name for name in CASES if name.startswith(options.only or "")])
    n, worst = sum(one for one, _ in found), max(one for _, one in found)
    if not options.only:
        common.write_result(
            folder, "field_formats",
            title="%d arrays in XDMF; joints handed over" % n,
            reference="VTU files, bitwise; outlines of the blocks",
            error=worst, tolerance=1e-12,
            seconds=round(time.monotonic() - start, 2), passed=True)
    print("passed: field_formats: %d arrays bitwise equal" % n)


if __name__ == "__main__":
    common.main(body)
