# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""What joints did that a single field of joints.pvd does not show: those that
were handed over to contacts, and what came after a time."""

import numpy as np

from quoin.joint_comparison import matched, nearest, reference_ends
from quoin.joint_states import INTACT, OPEN, SLIPPED
from quoin.vtu import Grid, from_the_start, merge

LEAST_GROWTH = 1e-2                  # of the largest, see since()
BESIDE = 0.1                         # of a face, from it to its contact


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


def handed_over(first, now, blocks, contacts, farthest):
    """The faces that @p now lacks of @p first, the first field of the run, as
    a Grid like these; None without any.

    Their ends are followed by the nodes of the two blocks that met there:
    opening and slip are the way between them [m], across and along the mean of
    both faces, and the line lies between these. Faces farther apart than
    @p farthest [m] are left out: there the blocks have gone separate ways.
    Tractions, states and fields of laws are those of the contact that lies on
    the line, from @p contacts; without one the face is open, or has slipped
    where it is closed, and has lost its bond. All of that counts from the start
    of the run, whatever a stage has reset.
    """
    blocks = from_the_start(blocks)
    of_first = reference_ends(first)
    is_lost = np.ones(len(of_first), dtype=bool)
    if now is not None:
        is_lost[matched(first, now)[0]] = False
    faces = np.flatnonzero(is_lost)
    edges = directed_outline(blocks)
    ends = blocks.points[edges].reshape(-1, 4)
    wanted = of_first[faces]
    near = 1e-6 * np.ptp(blocks.points, axis=0).max()
    upper, has_upper = nearest(wanted.reshape(-1, 4), ends, near)
    lower, has_lower = nearest(wanted[:, ::-1].reshape(-1, 4), ends, near)
    both = has_upper & has_lower
    # as it was first drawn from the lower side to the upper one
    upper, lower = edges[upper[both]], edges[lower[both], ::-1]
    u = blocks.point_data["displacement"][:, :2]
    x = blocks.points + u
    gap = x[upper] - x[lower]
    is_near = np.linalg.norm(gap.mean(axis=1), axis=1) <= farthest
    faces = faces[both][is_near]
    if len(faces) == 0:
        return None
    upper, lower, gap = upper[is_near], lower[is_near], gap[is_near]
    way = (np.diff(x[upper], axis=1) + np.diff(x[lower], axis=1))[:, 0]
    way /= np.maximum(np.linalg.norm(way, axis=1), 1e-300)[:, None]
    opening = gap[..., 1] * way[:, None, 0] - gap[..., 0] * way[:, None, 1]
    slip = np.einsum("fkd,fd->fk", gap, way)
    points = 0.5 * (x[upper] + x[lower]).reshape(-1, 2)
    moved = 0.5 * (u[upper] + u[lower]).reshape(-1, 2)
    length = first.cell_data["length"][faces]
    bears, contact = contacts_on(points.reshape(-1, 2, 2), contacts, length)

    def of_contact(name, otherwise):
        if contacts is None:
            return np.repeat(otherwise, 2)
        mean = contacts.point_data[name][contacts.cells].mean(axis=1)
        return np.repeat(np.where(bears, mean[contact], otherwise), 2)

    none = np.zeros(len(faces))
    state = np.where(opening.mean(axis=1) > 0.0, OPEN, SLIPPED)
    if contacts is not None:
        state = np.where(bears, contacts.cell_data["state"][contact], state)
    known = {"displacement": np.hstack([moved, 0.0 * moved[:, :1]]),
             "opening": opening.ravel(), "slip": slip.ravel(),
             "point state": np.repeat(state, 2)}
    point_data = {
        name: known[name] if name in known
        else of_contact(name, none + (name == "damage"))
        for name in first.point_data}
    if now is not None:
        for name in set(now.point_data) - set(first.point_data):
            # they have no earlier part, see from_the_start()
            point_data[name] = np.zeros((len(points),)
                                        + now.point_data[name].shape[1:])
    return Grid(now.time if now is not None else blocks.time, points,
                np.arange(len(points)).reshape(-1, 2), point_data,
                {"state": state, "length": length,
                 "joint set": first.cell_data["joint set"][faces]})


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


def all_joints(first, now, blocks, contacts, farthest):
    """The joints of a moment with those that were handed over by then."""
    if first is None:
        return now
    lost = handed_over(first, now, blocks, contacts, farthest)
    return merge([grid for grid in (now, lost) if grid is not None])


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


def since(joints, then, shear_stiffness):
    """The joints of a moment with what came after @p then, another field of
    the run: displacements, slips, tractions, and openings as far as they are
    beyond zero.

    Faces keep their state if they opened or, apart from elastic slip by
    @p shear_stiffness [Pa/m] of each joint set, slipped meanwhile by more than
    LEAST_GROWTH of what the one that moved most did; all others count as
    intact. Faces that were not there at @p then count from zero.
    """
    joints, then = from_the_start(joints), from_the_start(then)
    here, there, turned = matched(joints, then)
    before = {name: np.zeros_like(values, dtype=float)
              for name, values in joints.point_data.items()}
    at = joints.cells[here]
    from_then = then.cells[there]
    from_then = np.where(turned[:, None], from_then[:, ::-1], from_then)
    for name, values in before.items():
        values[at] = then.point_data[name][from_then]
    data = {name: values if name == "point state" else values - before[name]
            for name, values in joints.point_data.items()}
    data["opening"] = (np.maximum(joints.point_data["opening"], 0.0)
                       - np.maximum(before["opening"], 0.0))

    ends = joints.cells
    stiffness = np.asarray(shear_stiffness)[joints.cell_data["joint set"]]
    elastic = data["shear traction"][ends] / stiffness[:, None]
    slip = data["slip"][ends] - elastic
    growth = np.maximum(data["opening"][ends], np.abs(slip))
    moved = growth > LEAST_GROWTH * growth.max(initial=0.0)
    states = data["point state"][ends]
    data["point state"] = data["point state"].copy()
    data["point state"][ends] = np.where(moved, states, INTACT)
    state = np.where(moved.any(axis=1), joints.cell_data["state"], INTACT)
    return Grid(joints.time, joints.points, joints.cells, data,
                {**joints.cell_data, "state": state})
