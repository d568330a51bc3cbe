# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""How much of a run's joints has failed, from joints.pvd: the length, in three
dimensions the area, in each condition at every moment at which fields were
written."""

import os

import numpy as np

from quoin import joint_movement, run_parameters, vtu
from quoin.joint_states import INTACT, OPEN, SLIPPING
from quoin.moments import check_times

# name: what it says in a legend, in the order of columns
CONDITIONS = {
    "failed": "failed or softening",
    "slipping": "slipping",
    "open": "open",
    "damaged": "damaged > 50 %",
    "crushed": "crushed",
}


def is_in_space(joints):
    """Whether the faces of joints are triangles."""
    return joints.cells.shape[1] == 3


def lengths(joints, peak_crushing, sets=None):
    """Length of all joints and of those in each condition [m], in three
    dimensions area [m^2].

    Each corner of a face stands for an equal part of it. @p sets: numbers of
    the joint sets that count, None: all. Damage and crushing are missing where
    no joint softens.
    """
    corners = joints.cells
    n = corners.shape[1]
    size = joints.cell_data["area" if is_in_space(joints) else "length"]
    part = np.repeat(size[:, None] / n, n, axis=1)
    of_set = np.repeat(joints.cell_data["joint set"][:, None], n, axis=1)
    if sets is not None:
        part = np.where(np.isin(of_set, sets), part, 0.0)
    state = joints.point_data["point state"][corners]

    def total(which):
        return float(part[which].sum())

    found = {"all": float(part.sum()), "intact": total(state == INTACT),
             "slipping": total(state == SLIPPING),
             "open": total(state == OPEN)}
    if "damage" in joints.point_data:
        limit = np.asarray(peak_crushing)[of_set]
        found["damaged"] = total(joints.point_data["damage"][corners] > 0.5)
        found["crushed"] = total(joints.point_data["crushing"][corners]
                                 > limit)
    return found


def set_numbers(output, names):
    """Numbers of joint sets by their names in section 'Joints'."""
    known = run_parameters.joint_sets(output)
    for name in names:
        if name not in known:
            raise ValueError(f"there is no joint set '{name}'; there are "
                             + ", ".join(known))
    return [known.index(name) for name in names]


def grid_of(record):
    """Grid of a record of vtu.read_pvd()."""
    return vtu.merge([vtu.read_vtu(file) for file in record[1]])


def joints_since(series, then, output):
    """A function of the grid of a moment of a @p series: what came after the
    grid @p then alone, with one threshold for all moments."""
    stiffness = run_parameters.of_joint_sets(output, "Shear stiffness")
    largest = 0.0
    for grid in filter(None, map(grid_of, series)):
        if is_in_space(grid):
            raise ValueError("what came after a time, --since, is counted in "
                             "two dimensions alone")
        growth = joint_movement.moved_since(grid, then, stiffness)[1]
        largest = max(largest, growth.max(initial=0.0))
    return lambda grid: joint_movement.since(grid, then, stiffness, largest)


def read(output, names=(), time=None):
    """Times [s], and at each of them the length of the joints that are there
    [m] and lengths [m] in each condition, in three dimensions areas [m^2]; of
    the joint sets of these @p names, of all by default. What is excavated then
    or not placed yet has no joints, and the length is 0 where there are none.

    With a @p time [s]: of what came after the field nearest to it, and the
    moments after it (joint_movement.since()).

    Joints that large displacements handed over to contacts have failed: they
    are open or closed as their sides are, damaged and crushed as they were.
    """
    path = os.path.join(output, "joints.pvd")
    if not vtu.exists(path):
        raise ValueError(f"{path}: there is no such file; does the model have "
                         f"joints?")
    sets = set_numbers(output, names) if names else None
    peak_crushing = run_parameters.peak_crushing(output)
    series = vtu.read_pvd(path)
    counted = None
    if time is not None:
        check_times(output, "joints.pvd", [time])
        begin = min((moment for moment, _ in series),
                    key=lambda moment: abs(moment - time))
        then = vtu.read_at(path, begin)
        series = [record for record in series if record[0] >= begin]
        counted = joints_since(series, then, output)
    rows = []
    for record in series:
        grid = grid_of(record)
        if grid is not None and counted is not None:
            grid = counted(grid)
        rows.append({} if grid is None
                    else lengths(grid, peak_crushing, sets))
    times = [moment for moment, _ in series]
    length = np.array([row.get("all", 0.0) for row in rows])
    if not length.any():
        raise ValueError(f"{path}: there are no joints in it")
    for row in rows:
        row["failed"] = row.get("all", 0.0) - row.get("intact", 0.0)
    columns = {
        name: np.array([row.get(name, 0.0) for row in rows])
        for name in CONDITIONS if any(name in row for row in rows)}
    return np.array(times), length, columns
