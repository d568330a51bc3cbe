#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""A rigid tetrahedral wedge in a roof on three joints under the stress of the rock.

Points on the joints have a normal spring kn and shear springs ks in their plane, the
tractions of the initial stress at the start, and Coulomb's law. The weight grows by
increments; each finds the three displacements and the three rotations of the wedge
by Newton's method. While nothing slips that is the solution of K q = f with the
6 x 6 stiffness of the wedge on its springs.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
CORNERS = np.array([[-1.0, -0.6, 0], [1.2, -0.4, 0], [0.1, 1.1, 0],
                    [0.15, 0.05, 1.6]])
STRESS = np.array([[-60e3, 10e3, 0], [10e3, -40e3, 0], [0, 0, 0.0]])
KN, KS, DENSITY, GRAVITY = 200e6, 80e6, 2600.0, 9.81
WATCHED = (CORNERS[0] + CORNERS[2]) / 2


def points_on(triangle, parts=12):
    """Points and areas of the parts^2 small triangles that a triangle is cut into,
    each by three points that integrate quadratic functions exactly."""
    a, b, c = triangle
    places = []
    for i in range(parts):
        for j in range(parts - i):
            corners = [(i, j), (i + 1, j), (i, j + 1)]
            places += [(p, q) for p, q in three(corners)]
            if i + j < parts - 1:
                places += three([(i + 1, j + 1), (i + 1, j), (i, j + 1)])
    places = np.array(places) / parts
    points = a + places[:, :1] * (b - a) + places[:, 1:] * (c - a)
    area = np.linalg.norm(np.cross(b - a, c - a)) / 2
    return points, np.full(len(points), area / len(points))


def three(corners):
    corners = np.array(corners, dtype=float)
    return [tuple((np.sum(corners, axis=0) + 3 * corner) / 6)
            for corner in corners]


class Wedge:
    def __init__(self, corners=CORNERS, stress=STRESS, parts=12):
        centre = np.mean(corners, axis=0)
        apex, x, area, normal, self.joint = corners[3], [], [], [], []
        for i in range(3):
            a, b = corners[i], corners[(i + 1) % 3]
            n = np.cross(b - a, apex - a)
            n *= np.sign((a - centre) @ n) / np.linalg.norm(n)
            points, areas = points_on((a, b, apex), parts)
            x.append(points)
            area.append(areas)
            normal.append(np.tile(n, (len(points), 1)))
            self.joint += [i] * len(points)
        self.joint = np.array(self.joint)
        self.area, self.n = np.concatenate(area), np.concatenate(normal)
        arm = np.concatenate(x) - centre
        # displacement of a point: u + w x arm
        self.motion = np.zeros((len(arm), 3, 6))
        self.motion[:, :, :3] = np.eye(3)
        for k in range(3):
            self.motion[:, :, 3 + k] = np.cross(np.eye(3)[k], arm)
        self.centre = centre
        self.across = np.einsum("pi,pj->pij", self.n, self.n)
        self.along = np.eye(3) - self.across
        traction = self.n @ stress
        self.pressure = -np.einsum("pi,pi->p", traction, self.n)
        self.shear = traction + self.pressure[:, None] * self.n
        self.sunk = np.zeros(6)
        volume = abs(np.linalg.det(corners[:3] - apex)) / 6
        self.weight = DENSITY * GRAVITY * volume

    def tractions(self, step, friction):
        """Pressure and shear traction on the wedge after a step of its motion, and
        their derivative, -(3 x 3)."""
        moved = self.motion @ step
        # towards the rock closes a joint
        pressure = self.pressure + KN * np.einsum("pi,pi->p", moved, self.n)
        stiffness = KN * self.across + KS * self.along
        shear = self.shear - KS * np.einsum("pij,pj->pi", self.along, moved)
        size = np.linalg.norm(shear, axis=1)
        strength = friction * np.maximum(pressure, 0)
        slips = size > strength
        ratio = np.where(slips, strength / np.maximum(size, 1e-9), 1)
        way = shear / np.maximum(size, 1e-9)[:, None]
        yielding = (KN * self.across * (pressure > 0)[:, None, None]
                    + ratio[:, None, None] * KS
                    * (self.along - np.einsum("pi,pj->pij", way, way))
                    - friction * KN * (pressure > 0)[:, None, None]
                    * np.einsum("pi,pj->pij", way, self.n))
        stiffness = np.where(slips[:, None, None], yielding, stiffness)
        return (np.maximum(pressure, 0), shear * ratio[:, None], stiffness,
                slips)

    def resultants(self, pressure, shear):
        """Forces of the rock on the wedge, a joint in each row."""
        forces = (shear - pressure[:, None] * self.n) * self.area[:, None]
        return np.array([forces[self.joint == i].sum(axis=0)
                         for i in range(3)])

    def load(self, share, friction):
        """Equilibrium under this share of the weight from the last state on, if
        there is one."""
        step = np.zeros(6)
        weight = np.array([0, 0, -share * self.weight, 0, 0, 0])
        for _ in range(40):
            pressure, shear, stiffness, slips = self.tractions(step, friction)
            forces = (shear - pressure[:, None] * self.n) * self.area[:, None]
            unbalanced = weight + np.einsum("pij,pi->j", self.motion, forces)
            if np.linalg.norm(unbalanced) < 1e-9 * self.weight:
                self.pressure, self.shear = pressure, shear
                self.sunk = self.sunk + step
                return True
            tangent = np.einsum("pia,pij,pjb,p->ab", self.motion, stiffness,
                                self.motion, self.area, optimize=True)
            if np.linalg.cond(tangent) > 1e12:
                break
            step = step + np.linalg.solve(tangent, unbalanced)
            if np.linalg.norm(step) > 1e-2:
                break
        return False

    def stands(self, degrees, increments=100):
        friction = np.tan(np.radians(degrees))
        return all(self.load((i + 1) / increments, friction)
                   for i in range(increments))


def factor_of_safety(degrees=35.0, increments=50):
    """Largest factor by which friction may be lowered once the weight is borne."""
    friction, low, high = np.tan(np.radians(degrees)), 1.0, 3.0
    while high - low > 1e-4:
        middle, wedge = (low + high) / 2, Wedge()
        assert wedge.stands(degrees)
        low, high = ((middle, high) if all(
            wedge.load(1, friction / factor) for factor in np.linspace(
                1, middle, increments + 1)) else (low, middle))
    return (low + high) / 2


def limit(**wedge):
    """Least friction angle [deg] with which the wedge stays."""
    low, high = 5.0, 60.0
    while high - low > 1e-3:
        middle = (low + high) / 2
        low, high = ((low, middle) if Wedge(**wedge).stands(middle)
                     else (middle, high))
    return (low + high) / 2


def symmetric():
    """A wedge on three equal joints that slip everywhere at once: the numerical
    limit and the one by hand."""
    turns = 2 * np.pi / 3 * np.arange(3)
    corners = np.vstack([np.transpose([np.cos(turns), np.sin(turns), 0 * turns]),
                         [[0, 0, 1.6]]])
    pressure = 40e3
    wedge = dict(corners=corners, stress=-pressure * np.diag([1, 1, 0.0]))
    model = Wedge(**wedge, parts=2)
    area, a = np.sum(model.area), np.arcsin(model.n[0, 2])
    sink = model.weight / area / (KN * np.sin(a)**2 + KS * np.cos(a)**2)
    return limit(**wedge, parts=2), np.degrees(np.arctan(
        (pressure * np.sin(a) * np.cos(a) + KS * sink * np.cos(a))
        / (pressure * np.cos(a)**2 - KN * sink * np.sin(a))))


def main():
    found, by_hand = symmetric()
    assert abs(found - by_hand) < 2e-3, (found, by_hand)
    elastic = Wedge()
    assert elastic.stands(60, 1)
    assert not elastic.tractions(np.zeros(6), np.tan(np.radians(60)))[3].any()
    on_wedge = elastic.resultants(elastic.pressure, elastic.shear)
    moved = elastic.sunk[:3] + np.cross(elastic.sunk[3:],
                                        WATCHED - elastic.centre)
    angle, factor = limit(), factor_of_safety()
    print("friction angle %.3f deg (symmetric: %.3f, by hand %.3f), weight %.6g N"
          % (angle, found, by_hand, elastic.weight))
    for i in range(3):
        n = elastic.n[elastic.joint == i][0]
        across = on_wedge[i] @ n
        print("joint %s: normal %.1f N, shear %.1f N" % (
            "abc"[i], across, np.linalg.norm(on_wedge[i] - across * n)))
    # the rock is on the upper side of the joints
    row = np.concatenate([[0.3], -on_wedge.ravel(), moved])
    np.savetxt(os.path.join(HERE, "reference_forces.csv"), [row],
               delimiter=",", fmt="%.9g", comments="",
               header="time [s]," + ",".join(
                   "%s_%s [N]" % (joint, axis) for joint in "abc"
                   for axis in "xyz") + ",x [m],y [m],z [m]")
    np.savetxt(os.path.join(HERE, "reference.csv"), [[angle, factor]],
               delimiter=",", fmt="%.5g", comments="",
               header="friction angle [deg],factor [-]")


if __name__ == "__main__":
    main()
