#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Displacements of an unbounded elastic medium by a force that is spread over a
cube.

Kelvin's point force F at the origin gives at x, r = |x|,

  u = ((3 - 4 nu) F/r + x (x . F)/r^3)/(16 pi G (1 - nu)),

which is integrated over the cube by Gauss's rule.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
E, NU, DENSITY, HALF, OUTSIDE = 20e9, 0.25, 2500.0, 0.25, 3.0
G = E / (2 * (1 + NU))
GRAVITY = np.array([4.8, 6.0, -6.4])
FORCE = DENSITY * GRAVITY * (2 * HALF)**3
PLACES = {"near": (0.5, 0.2, -0.4), "along": (0.48, 0.6, -0.64),
          "across": (0.8, 0, 0.6), "oblique": (-0.3, 1.2, -0.4),
          "far": (1.2, -0.9, -1.2)}


def kelvin(x):
    """The displacement of a point force at the places x, last index of which are
    the axes."""
    r = np.linalg.norm(x, axis=-1)[..., None]
    return ((3 - 4 * NU) * FORCE / r + x * (x @ FORCE)[..., None] / r**3) / (
        16 * np.pi * G * (1 - NU))


def spread(x, n=40):
    """The same of a force spread over the cube."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    grid = np.stack(np.meshgrid(*3 * [HALF * nodes], indexing="ij"), axis=-1)
    w = np.einsum("i,j,k->ijk", weights, weights, weights) / 8
    return np.einsum("ijk,ijkl->l", w, kelvin(np.asarray(x) - grid))


def main():
    values, names = [0.0], ["time [s]"]
    largest = np.linalg.norm(spread((0, 0, 0)))
    for name, x in PLACES.items():
        assert np.allclose(spread(x), spread(x, 30), rtol=1e-9)
        values += list(spread(x))
        names += ["%s_%s [m]" % (name, axis) for axis in "xyz"]
        print("%-8s %s of the force's own %.4g m" % (
            name, np.array_str(spread(x) / largest, precision=4), largest))
    sides = [(OUTSIDE, y, z) for y in (-3, 0, 3) for z in (-3, 0, 3)]
    print("a point force on the sides: within %.1e" % max(
        np.max(np.abs(spread(x) - kelvin(np.array(x, dtype=float))))
        / largest for x in sides))
    np.savetxt(os.path.join(HERE, "reference.csv"), [values], delimiter=",",
               fmt="%.9g", comments="", header=",".join(names))


if __name__ == "__main__":
    main()
