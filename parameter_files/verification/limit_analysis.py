# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Collapse loads of rigid blocks on dry frictional joints.

Forces act at the two ends of every joint: a normal one n >= 0 and a shear one
|t| <= mu n. The unknowns of a mechanism are the velocities of the blocks, with
opening rates g >= 0 and slip rates s at the ends of the joints. Tension is
excluded, compressive strength unlimited. Needs scipy (python3-scipy).
"""
import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csr_matrix, hstack, identity, vstack


class Blocks:
    """Blocks and joints; block -1 is the ground."""

    def __init__(self):
        self.weights, self.centres, self.points = [], [], []

    def add_block(self, polygon):
        p = np.asarray(polygon, float)
        q = np.roll(p, -1, axis=0)
        cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
        self.weights.append(cross.sum() / 2)
        self.centres.append(((p + q) * cross[:, None]).sum(axis=0)
                            / (3 * cross.sum()))
        return len(self.weights) - 1

    def add_joint(self, a, b, ends, normal):
        """The normal points from a to b."""
        for end in ends:
            self.points.append((a, b, np.asarray(end, float),
                                np.asarray(normal, float)))


class LimitAnalysis:
    """Weights down and load * weights to the right."""

    def __init__(self, blocks, mu):
        self.mu = mu
        n_v, n_c = 3 * len(blocks.weights), len(blocks.points)
        normal, shear = np.zeros((n_v, n_c)), np.zeros((n_v, n_c))
        for k, (a, b, x, n) in enumerate(blocks.points):
            for block, sign in ((a, -1), (b, 1)):
                if block < 0:
                    continue
                arm = x - blocks.centres[block]
                rows = slice(3 * block, 3 * block + 3)
                for matrix, d in ((normal, n), (shear, (-n[1], n[0]))):
                    matrix[rows, k] += sign * np.array(
                        [d[0], d[1], arm[0] * d[1] - arm[1] * d[0]])
        self.live, self.dead = np.zeros(n_v), np.zeros(n_v)
        total = sum(blocks.weights)
        self.live[0::3] = np.array(blocks.weights) / total
        self.dead[1::3] = -np.array(blocks.weights) / total
        self.normal, self.shear = normal, shear
        one, zero = identity(n_c, format="csr"), csr_matrix((n_c, 1))
        self.equilibrium = csr_matrix(
            np.hstack([normal, shear, self.live[:, None]]))
        self.friction = vstack([hstack([-mu * one, one, zero]),
                                hstack([-mu * one, -one, zero])]).tocsr()
        none = csr_matrix((n_c, n_c))
        self.kinematics = vstack([
            hstack([csr_matrix(normal.T), -one, none, none]),
            hstack([csr_matrix(shear.T), none, one, -one]),
            csr_matrix(np.concatenate([self.live, np.zeros(3 * n_c)])[None])
        ]).tocsr()
        self.n_v, self.n_c = n_v, n_c

    def _forces(self, cost):
        """Forces in equilibrium, within friction, of least cost."""
        n_c = self.n_c
        done = linprog(
            cost, A_ub=self.friction, b_ub=np.zeros(2 * n_c),
            A_eq=self.equilibrium, b_eq=-self.dead, method="highs",
            bounds=[(0, None)] * n_c + [(None, None)] * n_c + [(0, None)])
        if done.status != 0:
            raise RuntimeError(done.message)
        return done.x[:n_c], done.x[n_c:2 * n_c], done.x[-1]

    def associative(self):
        """The largest load in equilibrium: static theorem."""
        cost = np.zeros(2 * self.n_c + 1)
        cost[-1] = -1
        return self._forces(cost)[2]

    def no_dilation(self, seed=0):
        """A collapse load with psi = 0: forces and a mechanism with
        n g = 0, (mu n - t) s- = 0, (mu n + t) s+ = 0 at every point.

        These products are bilinear, so forces and mechanism are found in
        turn, each by a linear program whose cost is the sum of the products
        and, for the forces, the load. The weight of the products grows until
        they vanish. Returns the load and the residual of the sum.
        """
        rng, mu, n_c = np.random.default_rng(seed), self.mu, self.n_c
        right = np.zeros(2 * n_c + 1)
        right[-1] = 1

        def mechanism(n, t, noise):
            back = np.maximum(mu * n - t, 0)
            forth = np.maximum(mu * n + t, 0)
            cost = np.concatenate([np.zeros(self.n_v), n, back, forth])
            cost[self.n_v:] += noise * rng.random(3 * n_c)
            done = linprog(
                cost, A_eq=self.kinematics, b_eq=right, method="highs",
                bounds=[(None, None)] * self.n_v + [(0, None)] * (3 * n_c))
            return np.split(done.x[self.n_v:], 3)

        n = rng.random(n_c)**2 / 20
        t = mu * n * rng.uniform(-1, 1, n_c)
        g, back, forth = mechanism(n, t, 0)
        for step in range(60):
            weight = (0.3, 1, 3, 10, 30, 100)[min(step // 4, 5)]
            n, t, load = self._forces(np.concatenate(
                [weight * (g + mu * (back + forth)),
                 weight * (forth - back), [1]]))
            g, back, forth = mechanism(n, t, 1e-5 if step < 40 else 0)
            gap = n @ g + (mu * n - t) @ back + (mu * n + t) @ forth
            if step > 28 and gap < 1e-9:
                break
        return load, gap
