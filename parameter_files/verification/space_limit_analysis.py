# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Collapse loads of rigid boxes on dry frictional joints.

Boxes with edges along x, y and z touch where their faces overlap. Forces act at
the four corners of each overlap: a normal one n >= 0 and a shear one |t| <= mu n,
which bear whatever forces at inner points would. The cone is a pyramid, within
it or around it. Supports are points at which a box is held along an axis.
Needs scipy (python3-scipy).
"""
import itertools

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_matrix, csr_matrix, hstack

SHORTEST = 1e-9


class Boxes:
    def __init__(self):
        self.low, self.high, self.fixed, self.held = [], [], [], []

    def add(self, low, high, fixed=False):
        self.low.append(np.asarray(low, float))
        self.high.append(np.asarray(high, float))
        self.fixed.append(fixed)
        return len(self.low) - 1

    def hold(self, box, point, axis):
        """The point of the box cannot move along the axis."""
        self.held.append((box, np.asarray(point, float), axis))

    def contacts(self):
        """(lower box, upper one, axis, four points) of all faces that touch."""
        for a, b in itertools.permutations(range(len(self.low)), 2):
            low = np.maximum(self.low[a], self.low[b])
            high = np.minimum(self.high[a], self.high[b])
            for axis in range(3):
                others = [i for i in range(3) if i != axis]
                if (abs(self.high[a][axis] - self.low[b][axis]) < SHORTEST
                        and all(high[i] - low[i] > SHORTEST for i in others)
                        and not (self.fixed[a] and self.fixed[b])):
                    points = []
                    for corner in itertools.product((0, 1), repeat=2):
                        point = np.empty(3)
                        point[axis] = self.high[a][axis]
                        for i, c in zip(others, corner):
                            point[i] = (low, high)[c][i]
                        points.append(point)
                    yield a, b, axis, points


class SpaceLimitAnalysis:
    """Weights down, and a factor of them along @p live. Friction mu of all faces,
    or of those across x, y and z."""

    def __init__(self, boxes, mu, live, sides=32, around=False):
        free = [i for i, fixed in enumerate(boxes.fixed) if not fixed]
        row = {box: 6 * k for k, box in enumerate(free)}
        entries, n = [], 0

        def act(box, point, direction, column):
            if box in row:
                arm = point - (boxes.low[box] + boxes.high[box]) / 2
                for i, value in enumerate((*direction,
                                           *np.cross(arm, direction))):
                    if value:
                        entries.append((row[box] + i, column, value))

        friction = []
        for a, b, axis, points in boxes.contacts():
            friction += [np.broadcast_to(mu, 3)[axis]] * 4
            across = [np.eye(3)[i] for i in range(3) if i != axis]
            for point in points:
                for direction in (np.eye(3)[axis], *across):
                    act(b, point, direction, n)
                    act(a, point, -direction, n)
                    n += 1
        self.n_points, self.n_held = n // 3, len(boxes.held)
        for box, point, axis in boxes.held:
            act(box, point, np.eye(3)[axis], n)
            n += 1
        rows, columns, values = zip(*entries)
        self.forces = coo_matrix((values, (rows, columns)),
                                 (6 * len(free), n)).tocsr()
        weights = np.array([np.prod(boxes.high[i] - boxes.low[i])
                            for i in free])
        weights /= weights.sum()
        self.dead, self.live = np.zeros((2, 6 * len(free)))
        self.dead[2::6] = -weights
        for i in range(3):
            self.live[i::6] = weights * live[i]
        # a row a side of the pyramid: (cos, sin) t <= reach n
        angles = 2 * np.pi * np.arange(sides) / sides
        reach = np.array(friction) * (1 if around else np.cos(np.pi / sides))
        self.friction = csr_matrix(
            np.kron(np.eye(self.n_points), np.column_stack(
                [np.zeros(sides), np.cos(angles), np.sin(angles)]))
            - np.kron(np.diag(reach),
                      np.outer(np.ones(sides), [1, 0, 0])))

    def associative(self):
        """The largest load in equilibrium: the collapse load where joints open
        by tan(phi) times their slip, else an upper bound."""
        cost = np.zeros(self.forces.shape[1] + 1)
        cost[-1] = -1
        n_limits = self.friction.shape[0]
        done = linprog(
            cost, method="highs", b_eq=-self.dead,
            A_eq=hstack([self.forces, csr_matrix(self.live[:, None])]).tocsr(),
            A_ub=hstack([self.friction,
                         csr_matrix((n_limits, self.n_held + 1))]).tocsr(),
            b_ub=np.zeros(n_limits),
            bounds=([(0, None), (None, None), (None, None)] * self.n_points
                    + [(None, None)] * self.n_held + [(0, None)]))
        if done.status != 0:
            raise RuntimeError(done.message)
        return done.x[-1]


class RigidBlocksOnSprings(SpaceLimitAnalysis):
    """The same boxes on springs [N/m^3] at the corners of each overlap, a quarter
    of its area each, without tension and without dilation, at small displacements.
    They are moved step by step with masses that make all steps stable, and a drag
    by velocity."""

    def __init__(self, boxes, mu, live, normal, shear, unit_weight):
        super().__init__(boxes, mu, live)
        volume = sum(np.prod(high - low) for low, high, fixed
                     in zip(boxes.low, boxes.high, boxes.fixed) if not fixed)
        self.mu, self.weight = mu, unit_weight * volume
        areas = []
        for _, _, axis, points in boxes.contacts():
            areas += [np.delete(np.ptp(points, axis=0), axis).prod() / 4] * 4
        self.kn, self.ks = normal * np.array(areas), shear * np.array(areas)

    def push(self, speed, distance, drag=0.05):
        """Mean displacements [m] along @p live, at a speed by step, and factors,
        from the weights at rest on."""
        springs = np.column_stack([self.kn, self.ks, self.ks]).ravel()
        holds = np.full(self.n_held, self.kn.max())
        sizes = abs(self.forces)
        mass = sizes @ (np.concatenate([springs, holds])
                        * (sizes.T @ np.ones(len(self.live)))) / 2
        forward, back = self.forces.toarray(), self.forces.T.toarray()
        u, velocity = np.zeros((2, len(self.live)))
        t = np.zeros((self.n_points, 2))
        live, dead = self.weight * self.live, self.weight * self.dead
        n_settle, n_push = 4000, int(distance / speed)
        moved, factors = [], []
        before = back @ u
        for step in range(n_settle + n_push):
            gap = back @ u
            change, before = gap - before, gap
            points = gap[:3 * self.n_points].reshape(-1, 3)
            n = np.maximum(-self.kn * points[:, 0], 0)
            slip = change[:3 * self.n_points].reshape(-1, 3)[:, 1:]
            t = t - self.ks[:, None] * slip
            size = np.hypot(t[:, 0], t[:, 1])
            t *= np.minimum(1, self.mu * n / np.maximum(size, 1e-30))[:, None]
            force = forward @ np.concatenate(
                [np.column_stack([n, t]).ravel(),
                 -holds * gap[3 * self.n_points:]]) + dead
            velocity = (1 - drag) * velocity + force / mass
            if step >= n_settle:
                factor = ((speed - self.live @ velocity)
                          / (self.live @ (live / mass)))
                velocity += factor * live / mass
                factors.append(factor)
                moved.append(self.live @ u)
            u = u + velocity
        return np.array(moved), np.array(factors)
