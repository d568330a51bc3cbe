# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""How much of a run's joints has failed, from joints.pvd: the length in each
condition at every moment at which fields were written."""

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


def lengths(joints, peak_crushing, sets=None):
    """Length of all joints and of those in each condition [m].

    Each end of a face stands for half of it. @p sets: numbers of the joint
    sets that count, None: all. Damage and crushing are missing where no joint
    softens.
    """
    ends = joints.cells
    half = np.repeat(0.5 * joints.cell_data["length"][:, None], 2, axis=1)
    of_set = np.repeat(joints.cell_data["joint set"][:, None], 2, axis=1)
    if sets is not None:
        half = np.where(np.isin(of_set, sets), half, 0.0)
    state = joints.point_data["point state"][ends]

    def total(which):
        return float(half[which].sum())

    found = {"all": float(half.sum()), "intact": total(state == INTACT),
             "slipping": total(state == SLIPPING),
             "open": total(state == OPEN)}
    if "damage" in joints.point_data:
        limit = np.asarray(peak_crushing)[of_set]
        found["damaged"] = total(joints.point_data["damage"][ends] > 0.5)
        found["crushed"] = total(joints.point_data["crushing"][ends] > limit)
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


def read(output, names=(), time=None):
    """Times [s], length of the joints [m], and lengths [m] in each condition
    at these times; of the joint sets of these @p names, of all by default.

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
    if time is not None:
        check_times(output, "joints.pvd", [time])
        then = vtu.read_at(path, time)
        series = [record for record in series if record[0] >= then.time]
        stiffness = run_parameters.of_joint_sets(output, "Shear stiffness")
        # one threshold for all moments
        largest = max(joint_movement.moved_since(grid, then, stiffness)[1]
                      .max(initial=0.0) for grid in map(grid_of, series)
                      if grid is not None)
    rows = []
    for record in series:
        grid = grid_of(record)
        if grid is not None and time is not None:
            grid = joint_movement.since(grid, then, stiffness, largest)
        rows.append({} if grid is None
                    else lengths(grid, peak_crushing, sets))
    times = [moment for moment, _ in series]
    if not rows or rows[0].get("all", 0.0) == 0.0:
        raise ValueError(f"{path}: there are no joints in it")
    length = rows[0]["all"]
    for row in rows:
        row["failed"] = length - row.get("intact", 0.0)
    columns = {
        name: np.array([row.get(name, 0.0) for row in rows])
        for name in CONDITIONS if name == "failed" or name in rows[0]}
    return np.array(times), length, columns
