# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Motion of a free block of tetrahedra in time steps, by the modes of its mesh.

Stiffness of constant strains and lumped masses are assembled anew, mixed
tetrahedra as eight that have the mean of their changes of volume.
"""
import numpy as np


def matrices(points, cells, young, poisson, rho, together=1):
    """Stiffness and the masses of the degrees of freedom. @p together cells, one
    after the other, share their change of volume."""
    bulk = young / 3 / (1 - 2 * poisson)
    mu = young / 2 / (1 + poisson)
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    volume = np.linalg.det(edges) / 6
    gradient = np.zeros((len(cells), 4, 3))
    gradient[:, 1:] = np.swapaxes(np.linalg.inv(edges), 1, 2)
    gradient[:, 0] = -gradient[:, 1:].sum(axis=1)
    volume = np.abs(volume)
    size = 3 * len(points)
    stiffness, mass = np.zeros((size, size)), np.zeros(size)
    for first in range(0, len(cells), together):
        mean = np.zeros(size)
        for c in range(first, first + together):
            dofs = (3 * cells[c][:, None] + np.arange(3)).ravel()
            g = gradient[c]
            # eps_ij eps_ij - (div u)^2/3, eps being the symmetric gradient
            part = (np.kron(g @ g.T, np.eye(3))
                    + np.einsum("aj,bi->aibj", g, g).reshape(12, 12)
                    - 2 / 3 * np.outer(g, g))
            stiffness[np.ix_(dofs, dofs)] += mu * volume[c] * part
            mean[dofs] += volume[c] * g.ravel()
            mass[dofs] += rho * volume[c] / 4
        used = np.flatnonzero(mean)
        total = volume[first:first + together].sum()
        stiffness[np.ix_(used, used)] += bulk / total * np.outer(mean[used],
                                                                 mean[used])
    return stiffness, mass


def weights(points, cells, place):
    """Those of the nodes in the linear interpolation at a place."""
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    inner = np.linalg.solve(np.swapaxes(edges, 1, 2),
                            (place - points[cells[:, 0]])[:, :, None])[..., 0]
    corners = np.column_stack([1 - inner.sum(axis=1), inner])
    c = np.argmax(corners.min(axis=1))
    found = np.zeros(len(points))
    found[cells[c]] = corners[c]
    return found


def displacements(stiffness, mass, velocity, places, steps, dt):
    """Displacements x, y, z at places, given by weights of the nodes, after
    numbers of steps of central differences that begin with a velocity: mode by
    mode sin(n a)/sin(a) times the first one, with 2 sin(a/2) = omega dt."""
    root = np.sqrt(mass)
    squares, vectors = np.linalg.eigh(stiffness / np.outer(root, root))
    share = vectors.T @ (root * velocity.ravel())
    a = 2 * np.arcsin(dt / 2 * np.sqrt(np.maximum(squares, 0)))
    rigid = a < 1e-6 * a.max()
    if np.sum(rigid) != 6:
        raise ValueError("%d rigid motions" % np.sum(rigid))
    a[rigid] = 1
    growth = np.where(rigid, steps[:, None],
                      np.sin(np.outer(steps, a)) / np.sin(a))
    shapes = np.einsum("pn,ncm->pcm", np.array(places),
                       (vectors / root[:, None]).reshape(-1, 3, len(root)))
    return np.einsum("nm,pcm->npc", dt * growth * share, shapes)
