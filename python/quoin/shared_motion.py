# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""The motion that all blocks of a run share, as on a shaken table or in rock
that a wave has moved: enlarged with the deformation it would hide that."""

from collections import namedtuple

import numpy as np

LEAST = 0.1                          # of the largest displacement
ALIKE = 0.2                          # of the turn of the whole, and of the rest


class Motion(namedtuple("Motion", "turn shift")):
    """From the places at the start X to R X + shift, where R turns by @p turn
    [rad], anticlockwise; shift (2) or, in three dimensions, (3) [m]."""

    def rotation(self):
        c, s = np.cos(self.turn), np.sin(self.turn)
        return (np.array([[c, -s], [s, c]]) if len(self.shift) == 2
                else np.eye(3))

    def taken_off(self, places):
        """Positions, (n, 2 or 3) [m], without the shared motion."""
        return (places - self.shift) @ self.rotation()


def cell_turns(X, x, cells):
    """Rotation of each triangle [rad]."""
    before, now = (np.stack([p[cells[:, 1]] - p[cells[:, 0]],
                             p[cells[:, 2]] - p[cells[:, 0]]], axis=2)
                   for p in (X, x))
    F = now @ np.linalg.inv(before)
    return np.arctan2(F[:, 1, 0] - F[:, 0, 1], F[:, 0, 0] + F[:, 1, 1])


def shared_motion(blocks):
    """The Motion that all blocks share, or None.

    There is none where a place has moved by less than LEAST of the one that
    moved most: on a foundation at rest a wall leans. It turns if every cell
    does so alike and little is left then; a uniform shear does not. Else it is
    that of the place that has moved least, if all others have moved that way,
    too.
    """
    used, cells = np.unique(blocks.cells, return_inverse=True)
    X = blocks.points[used]
    u = blocks.point_data["displacement"][used, :X.shape[1]]
    size = np.linalg.norm(u, axis=1)
    if size.min() <= LEAST * size.max():
        return None
    if X.shape[1] == 2:
        turns = np.exp(1j * cell_turns(X, X + u,
                                       cells.reshape(blocks.cells.shape)))
        turn = np.angle(turns.mean())
        # about the middle of all
        R = Motion(turn, np.zeros(2)).rotation()
        whole = Motion(turn, (X + u - X @ R.T).mean(axis=0))
        rest = np.linalg.norm(whole.taken_off(X + u) - X)
        if (np.abs(np.angle(turns * np.exp(-1j * turn))).max()
                <= ALIKE * abs(turn)
                and rest <= ALIKE * np.linalg.norm(u - u.mean(axis=0))):
            return whole
    least = u[size.argmin()]
    return (Motion(0.0, least)
            if (u @ least).min() > LEAST * size.max() * size.min() else None)


def enlarged(start, now, scale, motion):
    """Places [m] with displacements @p scale times as large, beyond @p motion
    if that is not None; as they are by a scale of 1."""
    if scale == 1.0:
        return now
    if motion is not None:
        now = motion.taken_off(now)
    return start + scale * (now - start)
