#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Convergence and confinement of a circular hole in Mohr-Coulomb rock with radial
grouted bolts, axisymmetric, integrated by linear elements along the radius with
nodes NR apart, small strains, plane strain.

Stage 1: the pressure on the wall falls from P0 to the share LEFT of it, without
bolts. Stage 2: it falls to nothing, and the bolts, DENSITY of them by radian and
length of the hole, count from there. Bars EA move along themselves relative to the
rock in the bond KB, with a plate KP at the wall.

Stresses return to the planes of Mohr-Coulomb in principal stresses r, t, z: of all
sets of one, two or three planes the one whose multipliers are positive and that
leaves no plane violated, with flow along the planes of the dilation angle.
"""
import itertools
import os

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

HERE = os.path.dirname(os.path.abspath(__file__))
INNER, OUTER, FAR = 1.0, 5.0, 3.0     # radii of wall, ring and ends of bolts [m]
PRESSURE, LEFT = 1.5e6, 0.4
YOUNG, POISSON = 1e9, 0.25
COHESION, FRICTION, DILATION = 0.1e6, 30.0, 30.0
EA = 200e9 * np.pi * 0.025 ** 2 / 4
KB, KP = 2e8, 1e9
YIELD = float(os.environ.get("YIELD", "inf"))
DENSITY = 8 / (np.pi / 2)             # bolts by radian and metre
N = 800

LAME = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
SHEAR = YOUNG / (2 * (1 + POISSON))
ELASTIC = LAME * np.ones((3, 3)) + 2 * SHEAR * np.eye(3)


def planes(degrees):
    """Normals of the six planes: (1 + sin) of one principal stress minus
    (1 - sin) of another, tension positive."""
    sine = np.sin(np.radians(degrees))
    rows = []
    for a, b in itertools.permutations(range(3), 2):
        row = np.zeros(3)
        row[a], row[b] = 1 + sine, -(1 - sine)
        rows.append(row)
    return np.array(rows)


NORMALS, FLOWS = planes(FRICTION), planes(DILATION)
LIMIT = 2 * COHESION * np.cos(np.radians(FRICTION))
SETS = [s for size in (1, 2, 3) for s in itertools.combinations(range(6), size)]


def returned(trial):
    """Stress and its derivative by the elastic trial strain."""
    if np.max(NORMALS @ trial) <= LIMIT + 1e-9 * PRESSURE:
        return trial, ELASTIC
    for active in SETS:
        f, g = NORMALS[list(active)], FLOWS[list(active)]
        matrix = f @ ELASTIC @ g.T
        if abs(np.linalg.det(matrix)) < 1e-12 * np.linalg.norm(matrix):
            continue
        multipliers = np.linalg.solve(matrix, f @ trial - LIMIT)
        stress = trial - ELASTIC @ g.T @ multipliers
        if np.all(multipliers >= 0) and \
                np.max(NORMALS @ stress) <= LIMIT + 1e-9 * PRESSURE:
            tangent = ELASTIC - ELASTIC @ g.T @ np.linalg.solve(
                matrix, f @ ELASTIC)
            return stress, tangent
    raise RuntimeError("no return of %s" % trial)


class Hole:
    def __init__(self):
        self.r = np.linspace(INNER, OUTER, N + 1)
        self.middle = (self.r[1:] + self.r[:-1]) / 2
        self.h = np.diff(self.r)
        self.n_bar = int(round((FAR - INNER) / self.h[0])) + 1
        self.u = np.zeros(N + 1 + self.n_bar)     # rock, then bars
        self.stress = np.full((N, 3), -PRESSURE)
        self.old_strain = np.zeros((N, 3))
        self.start = None                         # of the bars
        self.plastic = np.zeros(self.n_bar - 1)

    def strains(self, u):
        u = u[:N + 1]
        return np.column_stack([np.diff(u) / self.h,
                                (u[1:] + u[:-1]) / 2 / self.middle,
                                np.zeros(N)])

    def forces(self, u, wall):
        """Residual, stiffness, stresses, bar forces, by radian."""
        n = len(self.u)
        residual, rows, columns, values = np.zeros(n), [], [], []
        change = self.strains(u) - self.old_strain
        stress = np.zeros((N, 3))
        for e in range(N):
            stress[e], tangent = returned(self.stress[e]
                                          + ELASTIC @ change[e])
            b = np.array([[-1 / self.h[e], 1 / self.h[e]],
                          [0.5 / self.middle[e], 0.5 / self.middle[e]]])
            weight = self.middle[e] * self.h[e]
            residual[e:e + 2] -= weight * b.T @ stress[e][:2]
            k = weight * b.T @ tangent[:2, :2] @ b
            for i in range(2):
                for j in range(2):
                    rows.append(e + i)
                    columns.append(e + j)
                    values.append(k[i, j])
        residual[0] += wall * INNER
        residual[N] -= PRESSURE * OUTER
        bars = np.zeros(self.n_bar - 1)

        def spring(i, j, k, force):
            residual[i] -= -force
            residual[j] -= force
            for a, b, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
                rows.append(a)
                columns.append(b)
                values.append(sign * k)

        for i in range(self.n_bar):
            w = N + 1 + i
            if self.start is None:
                rows.append(w)
                columns.append(w)
                values.append(1.0)
                continue
            share = self.h[0] * (0.5 if i in (0, self.n_bar - 1) else 1.0)
            k = DENSITY * (KB * share + (KP if i == 0 else 0.0))
            slip = (u[w] - u[i]) - 0.0
            spring(i, w, k, k * slip)
            if i + 1 < self.n_bar:
                k = DENSITY * EA / self.h[0]
                trial = EA * ((u[w + 1] - u[w]) / self.h[0] - self.plastic[i])
                bars[i] = np.clip(trial, -YIELD, YIELD)
                spring(w, w + 1, k if abs(trial) < YIELD else 1e-9 * k,
                       DENSITY * bars[i])
        return residual, csc_matrix((values, (rows, columns)), (n, n)), \
            stress, bars

    def unload(self, begin, end, steps):
        for step in range(steps):
            wall = PRESSURE * (begin + (end - begin) * (step + 1) / steps)
            for _ in range(60):
                residual, stiffness, stress, bars = self.forces(self.u, wall)
                if np.max(np.abs(residual)) < 1e-8 * PRESSURE:
                    break
                self.u = self.u + splu(stiffness).solve(residual)
            else:
                raise RuntimeError("no equilibrium")
            self.stress, self.old_strain = stress, self.strains(self.u)
            if self.start is not None:
                w = self.u[N + 1:]
                self.plastic = np.diff(w) / self.h[0] - bars / EA
        return bars

    def install(self):
        """Bars count from the present positions of the rock."""
        self.start = self.u[:self.n_bar].copy()
        self.u[N + 1:] = self.start
        self.plastic = np.diff(self.start) / self.h[0]


def main():
    hole = Hole()
    hole.unload(1.0, LEFT, 12)
    rows = [(1, hole.u[0], 0.0, 0.0)]
    hole.install()
    bars = hole.unload(LEFT, 0.0, 12)
    plate = KP * (hole.u[N + 1] - hole.u[0])
    rows.append((2, hole.u[0], bars.max(), plate))
    bare = Hole()
    bare.unload(1.0, 0.0, 24)
    print("wall %.4g m, without bolts %.4g m, largest force %.4g N at r = %.3g"
          " m" % (hole.u[0], bare.u[0], bars.max(),
                  hole.middle[bars.argmax()]))
    with open(os.path.join(HERE, "reference.csv"), "w") as stream:
        stream.write("stage [-],wall [m],largest [N],plate [N]\n")
        for row in rows:
            stream.write("%d,%.6g,%.6g,%.6g\n" % row)


if __name__ == "__main__":
    main()
