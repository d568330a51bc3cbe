#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Cavity of the radius a under pressure, as cavity_step: displacements at the
wall and at 1.5 a, and the mean of the stress yy of the two triangles whose
histories the case writes."""
import importlib.util
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
specification = importlib.util.spec_from_file_location(
    "cavity", os.path.join(HERE, os.pardir, "cavity_step",
                           "make_reference.py"))
cavity = importlib.util.module_from_spec(specification)
specification.loader.exec_module(cavity)


def centre():
    """Mean centre of the two triangles at the wall beside the x axis: 96 edges
    around, 24 to twice the radius."""
    outer = 1 + 1 / 24
    step = 2 * np.pi / 96
    c, s = np.cos(step), np.sin(step)
    corners = np.array([[1, 0], [c, s], [outer, 0],
                        [c, s], [outer, 0], [outer * c, outer * s]])
    return corners.mean(axis=0)


def radial(pressure, R, tau):
    """sigma_r / p, from the hoop stress and the displacement: plane strain."""
    u, hoop = cavity.quantities(pressure, R, tau).T
    # sigma_t = lambda (u' + u/r) + 2 mu u/r gives u', and that sigma_r
    nu = cavity.NU
    ratio = nu / (1 - nu)
    modulus = 2 * (1 - nu) / (1 - 2 * nu)  # (lambda + 2 mu) / mu
    strain = u / R / 2  # u/r in units of p / mu
    slope = (hoop - modulus * strain) / (ratio * modulus)
    return hoop, modulus * (slope + ratio * strain)


def main():
    tau = np.arange(0.2, 20.0, 0.2)
    x, y = centre()
    R, t = np.hypot(x, y), np.arctan2(y, x)
    displacement = cavity.PRESSURE * cavity.RADIUS / (2 * cavity.MU)
    for name, pressure in (("reference.csv", cavity.step),
                           ("reference_decay.csv", cavity.decaying)):
        wall = cavity.quantities(pressure, 1.0, tau)[:, 0]
        inside = cavity.quantities(pressure, 1.5, tau)[:, 0]
        hoop, across = radial(pressure, R, tau)
        syy = hoop * np.cos(t)**2 + across * np.sin(t)**2
        np.savetxt(os.path.join(HERE, name), np.transpose(
            [tau * cavity.RADIUS / cavity.C1, displacement * wall,
             displacement * inside, cavity.PRESSURE * syy]),
            delimiter=",", fmt="%.6g", comments="",
            header="time [s],u_wall [m],u_inside [m],hoop [Pa]")

    # 2 MPa at rest: u = p a^2 / (2 mu r).
    wall = 2 * displacement
    np.savetxt(os.path.join(HERE, "reference_static.csv"),
               [[1, wall, -wall, wall / 1.5]], delimiter=",", fmt="%.9g",
               comments="",
               header="time [s],u_wall [m],u_left [m],u_inside [m]")


if __name__ == "__main__":
    main()
