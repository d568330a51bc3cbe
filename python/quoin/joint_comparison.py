# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""How far the joints of two runs of one model are in the same condition."""

import numpy as np

from quoin.vtu import from_the_start

CLOSED, SLIDING, OPEN = 0, 1, 2
NAMES = ("closed", "sliding", "open")
MOST_AT_ONCE = 2e6                   # distances


def inelastic_slip(joints, shear_stiffness):
    """Slip of both ends of each face without its elastic part [m]: that of the
    run, which knows of initial stresses and of stiffnesses that change; where
    joints were handed over to contacts, and of runs that did not write it, by
    @p shear_stiffness [Pa/m] of each joint set."""
    ends, data = joints.cells, joints.point_data
    stiffness = np.asarray(shear_stiffness)[joints.cell_data["joint set"]]
    slip = data["slip"][ends] - data["shear traction"][ends] / stiffness[:, None]
    if "inelastic slip" not in data:
        return slip
    is_over = joints.cell_data["handed over"] != 0
    return np.where(is_over[:, None], slip, data["inelastic slip"][ends])


def classes(joints, shear_stiffness, threshold):
    """Class of both ends of each face: open if the opening is above
    @p threshold [m], else sliding if the inelastic_slip() is, else closed."""
    joints = from_the_start(joints)
    ends = joints.cells
    slip = np.abs(inelastic_slip(joints, shear_stiffness))
    return np.where(joints.point_data["opening"][ends] > threshold, OPEN,
                    np.where(slip > threshold, SLIDING, CLOSED))


def reference_ends(joints):
    """Ends of the faces where nothing has moved yet [m], (n, 2, 2)."""
    moved = from_the_start(joints).point_data["displacement"][:, :2]
    return (joints.points - moved)[joints.cells]


def nearest(places, others, near):
    """The nearest of @p others, (m, d), to each of @p places, (n, d) [m], and
    whether it is nearer than @p near."""
    found = np.zeros(len(places), dtype=int)
    if len(others) == 0:
        return found, np.zeros(len(places), dtype=bool)
    rows = max(1, int(MOST_AT_ONCE / len(others)))
    for k in range(0, len(places), rows):
        part = places[k:k + rows, None] - others[None]
        found[k:k + rows] = (part ** 2).sum(axis=2).argmin(axis=1)
    return found, np.linalg.norm(places - others[found], axis=1) < near


def matched(first, second):
    """Faces that both grids have: their numbers in each, and whether the
    ends of each stand in the other order. Ranks number faces differently, and
    joints that were handed over to contacts are in no grid."""
    a, b = reference_ends(first), reference_ends(second)
    near = 1e-6 * max(np.ptp(a.reshape(-1, 2), axis=0).max(), 1e-12)
    n = len(a)
    if len(b) == n and np.abs(a - b).max() < near:
        return np.arange(n), np.arange(n), np.zeros(n, dtype=bool)
    of_second, found = nearest(a.mean(axis=1), b.mean(axis=1), near)
    of_first, of_second = np.flatnonzero(found), of_second[found]
    turned = np.linalg.norm(a[of_first, 0] - b[of_second, 0], axis=1) > near
    return of_first, of_second, turned


def in_order(values, faces, turned):
    """Values at the ends, (all faces, 2), of these faces in common order."""
    values = values[faces]
    return np.where(turned[:, None], values[:, ::-1], values)


def agreement(first, second, shear_stiffness, threshold):
    """What two grids of joints have in common, each end of a face standing
    for half of its length.

    Shares of the length of the joints: "same class", and "same damage", lost
    more than half of their strength in both or in neither, where the joints
    soften. "open in both" and "cracked in both" (open or sliding) are shares
    of the length that is so in either run, None if it is so in neither: most
    joints of a wall are closed in both, which says little.
    """
    of_first, of_second, turned = matched(first, second)
    if len(of_first) == 0:
        raise ValueError("the two runs have no joint in common: are they of "
                         "one model?")
    unturned = np.zeros(len(of_first), dtype=bool)
    a = in_order(classes(first, shear_stiffness, threshold), of_first, unturned)
    b = in_order(classes(second, shear_stiffness, threshold), of_second, turned)
    half = np.repeat(0.5 * first.cell_data["length"][of_first][:, None], 2,
                     axis=1)
    length = half.sum()

    def shared(is_a, is_b):
        either = half[is_a | is_b].sum()
        return float(half[is_a & is_b].sum() / either) if either else None

    found = {"length [m]": float(length),
             "same class": float(half[a == b].sum() / length),
             "open in both": shared(a == OPEN, b == OPEN),
             "cracked in both": shared(a != CLOSED, b != CLOSED)}
    for name, values in (("explicit", a), ("implicit", b)):
        found[f"{name} [m]"] = {
            NAMES[k]: float(half[values == k].sum())
            for k in (CLOSED, SLIDING, OPEN)}
    if "damage" in first.point_data and "damage" in second.point_data:
        damaged = [
            in_order(grid.point_data["damage"][grid.cells], faces, order) > 0.5
            for grid, faces, order in ((first, of_first, unturned),
                                       (second, of_second, turned))]
        found["same damage"] = float(
            half[damaged[0] == damaged[1]].sum() / length)
        found["damaged in both"] = shared(*damaged)
    return found
