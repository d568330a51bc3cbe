# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What joints did that a single field of joints.pvd does not show: what the
contacts bear to which they were handed over, and what came after a time."""

import numpy as np

from quoin.geometry import cross
from quoin.joint_comparison import inelastic_slip, matched
from quoin.joint_states import INTACT
from quoin.vtu import Grid, from_the_start

LEAST_GROWTH = 1e-2                  # of the largest, see since()
BESIDE = 0.1                         # of a face, from it to its contact


def contacts_on(lines, contacts, length):
    """Whether a contact lies on the middle of each line, (n, 2, 2), and its
    number."""
    number = np.zeros(len(lines), dtype=int)
    if contacts is None:
        return np.zeros(len(lines), dtype=bool), number
    middle = lines.mean(axis=1)
    a, b = contacts.points[contacts.cells].transpose(1, 0, 2)
    square = np.maximum(((b - a) ** 2).sum(axis=1), 1e-300)
    distance = np.empty(len(lines))
    for k, place in enumerate(middle):
        share = np.clip(((place - a) * (b - a)).sum(axis=1) / square, 0.0, 1.0)
        apart = np.linalg.norm(a + share[:, None] * (b - a) - place, axis=1)
        number[k] = apart.argmin()
        distance[k] = apart[number[k]]
    return distance <= BESIDE * length, number


def all_joints(joints, contacts, farthest):
    """The joints of a moment, of which those that were handed over to contacts
    have tractions, states and fields of laws of the contact that lies on them.
    One without a contact keeps its own, which bears nothing. Those whose sides
    are farther apart than @p farthest [m], or have turned against each other by
    more than 60 degrees, are left out: there the blocks have gone separate ways.
    None if nothing is left."""
    if joints is None:
        return None
    is_over = joints.cell_data["handed over"] != 0
    moved = from_the_start(joints).point_data
    apart = np.stack([moved[name][joints.cells] for name in ("opening", "slip")])
    # a gap that grows by twice the sine of half the turn along a face
    turned = np.linalg.norm(apart[:, :, 1] - apart[:, :, 0], axis=0)
    stays = ~is_over | ((np.linalg.norm(apart.mean(axis=2), axis=0) <= farthest)
                        & (turned <= joints.cell_data["length"]))
    if not stays.any():
        return None
    ends = joints.cells[stays].ravel()
    shown = Grid(joints.time, joints.points[ends],
                 np.arange(len(ends)).reshape(-1, 2),
                 {name: v[ends] for name, v in joints.point_data.items()},
                 {name: v[stays] for name, v in joints.cell_data.items()})
    faces = np.flatnonzero(is_over[stays])
    bears, contact = contacts_on(shown.points[shown.cells[faces]], contacts,
                                 shown.cell_data["length"][faces])
    faces, contact = faces[bears], contact[bears]
    if len(faces) > 0:
        state = contacts.cell_data["state"][contact]
        shown.cell_data["state"][faces] = state
        shown.point_data["point state"][shown.cells[faces]] = state[:, None]
        own = {"displacement", "earlier displacement", "opening", "slip",
               "point state"}
        for name in (set(shown.point_data) & set(contacts.point_data)) - own:
            mean = contacts.point_data[name][contacts.cells].mean(axis=1)
            shown.point_data[name][shown.cells[faces]] = mean[contact, None]
    return shown


def blocks_since(blocks, then):
    """Blocks whose displacements are those since @p then, and whose points
    the places at that time. Blocks that were not there count from their own
    beginning."""
    def names(grid):
        block = np.zeros(len(grid.points))
        block[grid.cells] = grid.cell_data["block"][:, None]
        return np.column_stack([grid.points, block])

    blocks, then = from_the_start(blocks), from_the_start(then)
    u = blocks.point_data["displacement"].copy()
    first = names(blocks)
    if np.array_equal(first, names(then)):
        before = then.point_data["displacement"]
    else:
        # exactly the same numbers, in another order or with gaps
        known = {row.tobytes(): k for k, row in enumerate(names(then))}
        place = np.array([known.get(row.tobytes(), -1) for row in first])
        before = np.where((place >= 0)[:, None],
                          then.point_data["displacement"][place], 0.0)
    return Grid(blocks.time, blocks.points + before[:, :2], blocks.cells,
                {**blocks.point_data, "displacement": u - before},
                blocks.cell_data)


def displacement_at(blocks, places):
    """Displacement of blocks at places in the mesh, (n, 2) [m], as their
    cells have it."""
    a, b, c = (blocks.points[blocks.cells[:, k], :2] for k in range(3))
    area = cross(b - a, c - a)
    found = np.empty((len(places), blocks.point_data["displacement"].shape[1]))
    for k, place in enumerate(places):
        weights = np.stack([cross(b - place, c - place),
                            cross(c - place, a - place),
                            cross(a - place, b - place)]) / area
        cell = weights.min(axis=0).argmax()
        # A block that was not there then counts from its own beginning.
        found[k] = 0.0 if weights[:, cell].min() < -0.1 else (
            weights[:, cell] @ blocks.point_data["displacement"][
                blocks.cells[cell]])
    return found


def bars_since(bars, then):
    """Bolts whose displacements are those since the moment of the blocks @p
    then, installed by then or not: they are those of the rock."""
    bars, then = from_the_start(bars), from_the_start(then)
    u = bars.point_data["displacement"]
    before = displacement_at(then, bars.points[:, :2] - u[:, :2])
    return Grid(bars.time, bars.points, bars.cells,
                {**bars.point_data, "displacement": u - before}, bars.cell_data)


def moved_since(joints, then, shear_stiffness):
    """The joints of a moment with what came after @p then, another field of
    the run: displacements, slips, tractions, and openings as far as they are
    beyond zero; and how far each end of a face opened or, by its
    inelastic_slip(), slipped meanwhile [m].
    Faces that were not there at @p then, None if there were none, count from
    zero.
    """
    joints = from_the_start(joints)
    before = {name: np.zeros_like(values, dtype=float)
              for name, values in joints.point_data.items()}
    if then is not None:
        then = from_the_start(then)
        here, there, turned = matched(joints, then)
        at = joints.cells[here]
        from_then = then.cells[there]
        from_then = np.where(turned[:, None], from_then[:, ::-1], from_then)
        for name, values in before.items():
            values[at] = then.point_data[name][from_then]
    data = {name: values if name == "point state" else values - before[name]
            for name, values in joints.point_data.items()}
    data["opening"] = (np.maximum(joints.point_data["opening"], 0.0)
                       - np.maximum(before["opening"], 0.0))

    moved = Grid(joints.time, joints.points, joints.cells, data,
                 joints.cell_data)
    slip = np.abs(inelastic_slip(moved, shear_stiffness))
    return moved, np.maximum(data["opening"][joints.cells], slip)


def since(joints, then, shear_stiffness, largest=None):
    """The joints of moved_since(). Faces keep their state if they moved by more
    than LEAST_GROWTH of @p largest [m], by default of what the one that moved
    most did; all others count as intact."""
    found, growth = moved_since(joints, then, shear_stiffness)
    if largest is None:
        largest = growth.max(initial=0.0)
    moved = growth > LEAST_GROWTH * largest
    ends, data = found.cells, found.point_data
    states = data["point state"][ends]
    data["point state"] = data["point state"].copy()
    data["point state"][ends] = np.where(moved, states, INTACT)
    state = np.where(moved.any(axis=1), found.cell_data["state"], INTACT)
    return Grid(found.time, found.points, ends, data,
                {**found.cell_data, "state": state})
