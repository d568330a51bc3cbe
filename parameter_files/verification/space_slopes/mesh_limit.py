#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Factor of safety of the slice of a cut in clay that its mesh allows.

  mesh_limit.py OUTPUT_DIR

Of all velocities of the nodes of the mesh of a run, whose tetrahedra are in
groups of eight that keep the volume of the group, those that dissipate least for
the power of gravity: the least upper bound of limit analysis (kinematic theorem)
with these elements. Clay that yields by Tresca dissipates c times the sum of the
magnitudes of the principal strain rates. It is minimised by least squares with
weights (e e)^(-1/2), matrices, from the last solution's rates e. Of the run
nothing but the mesh is used. Needs scipy (python3-scipy).
"""
import os
import sys

import numpy as np
from scipy.sparse import bmat, csr_matrix, diags, vstack
from scipy.sparse.linalg import splu

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "..", "python"))
from quoin import vtu  # noqa: E402

WEIGHT, COHESION = 20e3, 12e3   # [N/m^3], [Pa]
PENALTY = 1e6                   # of volume, by the largest weight
PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
# symmetric matrices from their six components, whose norm they keep
BASIS = np.zeros((6, 3, 3))
for k, (i, j) in enumerate(PLACES):
    BASIS[k, i, j] = BASIS[k, j, i] = 1.0 if i == j else np.sqrt(0.5)


def factor(points, cells, iterations=200):
    corners = points[cells]
    edges = np.moveaxis(corners[:, 1:] - corners[:, :1], 1, 2)
    volume = np.abs(np.linalg.det(edges)) / 6
    inverse = np.linalg.inv(edges)
    slope = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], 1)
    count, n = len(points), len(cells)
    shape = (n, 3 * count)

    def derivative(component, axis):
        rows = np.repeat(np.arange(n), 4)
        return csr_matrix((slope[:, :, axis].ravel(),
                           (rows, 3 * cells.ravel() + component)), shape)

    low, high = points.min(axis=0), points.max(axis=0)
    bottom = np.isclose(points[:, 2], low[2])
    side = np.isclose(points[:, 0], low[0]) | np.isclose(points[:, 0], high[0])
    end = np.isclose(points[:, 1], low[1]) | np.isclose(points[:, 1], high[1])
    free = ~np.stack([bottom | side, bottom | end, bottom], 1).ravel()
    normal = [derivative(k, k) for k in range(3)]
    shear = [0.5 * (derivative(i, j) + derivative(j, i))
             for i, j in ((0, 1), (0, 2), (1, 2))]
    # of groups of eight the mean change of volume
    groups = csr_matrix((volume, (np.arange(n) // 8, np.arange(n))),
                        (n // 8, n))
    change = (groups @ sum(normal)).tocsc()[:, free]
    size = np.asarray(groups.sum(axis=1)).ravel()
    trace = sum(normal) / 3
    rates = [(d - trace).tocsc()[:, free] for d in normal]
    rates += [np.sqrt(2) * s.tocsc()[:, free] for s in shear]
    rate = vstack(rates).tocsc()
    load = np.zeros(3 * count)
    for k in range(4):
        np.add.at(load, 3 * cells[:, k] + 2, -WEIGHT * volume / 4)
    load = load[free]
    kept = PENALTY * change.T @ diags(1 / size) @ change

    weight, least = np.broadcast_to(np.eye(3), (n, 3, 3)), np.inf
    for _ in range(iterations):
        scaled = (volume / np.max(np.trace(weight, axis1=1, axis2=2)))
        form = np.einsum("n,aij,njk,bki->nab", scaled, BASIS, weight, BASIS)
        form = bmat([[diags(0.5 * (form[:, a, b] + form[:, b, a]))
                      for b in range(6)] for a in range(6)])
        matrix = rate.T @ form @ rate + kept
        velocity = splu(matrix.tocsc()).solve(load)
        velocity /= load @ velocity
        e = np.einsum("an,aij->nij", (rate @ velocity).reshape(6, n), BASIS)
        values, vectors = np.linalg.eigh(e)
        values = np.abs(values)
        least = min(least, COHESION * volume @ values.sum(axis=1))
        weight = np.einsum("nik,nk,njk->nij", vectors,
                           1 / np.maximum(values, 1e-5 * values.max()), vectors)
    return least


if __name__ == "__main__":
    grid = vtu.read_at(os.path.join(sys.argv[1], "blocks.pvd"))
    print("factor of safety of the mesh: %.4f"
          % factor(grid.points, grid.cells))
