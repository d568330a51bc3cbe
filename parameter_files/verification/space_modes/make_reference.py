#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Free vibrations of an elastic parallelepiped by Rayleigh and Ritz.

Displacements are sums of products of Legendre polynomials up to a total degree,
as in resonant ultrasound spectroscopy. Without arguments it writes
frequencies.csv; it says how much the last degrees still change.
"""
import itertools
import os

import numpy as np
import scipy.linalg

HERE = os.path.dirname(os.path.abspath(__file__))
RHO, E, NU = 2500.0, 25e9, 0.25
EDGES = (1.0, 0.7, 0.5)
DEGREE = 18
# the history from which the frequency of each mode is read: component, place,
# and the place whose displacement it is relative to that
HISTORIES = {
    "twist": (2, (1.0, 0.0, 0.25), (1.0, 0.7, 0.25)),
    "bend_z": (2, (1.0, 0.35, 0.25)),
    "bend_y": (1, (1.0, 0.35, 0.25)),
    "shear": (0, (0.5, 0.7, 0.25)),
    "stretch": (0, (1.0, 0.35, 0.25)),
    "counter_twist": (2, (0.5, 0.0, 0.25), (0.5, 0.7, 0.25)),
}


def velocity(x, y, z):
    """That with which case.prm begins."""
    x, y, z = x - 0.5, y - 0.35, z - 0.25
    return 1e-5 * np.transpose([x * (1 - 2 * y - 2 * z) + y,
                                x * (x + 1 - 2 * z) - 1 / 12,
                                x * (x + 2 * y) - 1 / 12
                                + y * (12 * x**2 - 1)])


def products(degree):
    """Integrals over [-1, 1] of P_i P_j, P_i' P_j and P_i' P_j'."""
    points, weights = np.polynomial.legendre.leggauss(degree + 1)
    one = np.eye(degree + 1)
    value = np.array([np.polynomial.legendre.legval(points, c) for c in one])
    slope = np.array([np.polynomial.legendre.legval(
        points, np.polynomial.legendre.legder(c)) for c in one])
    return [[a * weights @ b.T for b in (value, slope)]
            for a in (value, slope)]


def frequencies(edges=EDGES, degree=DEGREE, young=E, poisson=NU, rho=RHO):
    """[(frequency [Hz], parity)], ascending, the six rigid motions left out.
    The parity is that of u_x in x, y and z, 0 if it is even; that of u_y is
    the same but for x and y, that of u_z but for x and z."""
    lam = young * poisson / (1 + poisson) / (1 - 2 * poisson)
    mu = young / 2 / (1 + poisson)
    table = products(degree)
    half = np.array(edges) / 2
    found = []
    for parity in itertools.product((0, 1), repeat=3):
        basis = []
        for component in range(3):
            wanted = list(parity)
            if component:
                wanted[0] ^= 1
                wanted[component] ^= 1
            basis += [(component, *p) for p in itertools.product(
                range(degree + 1), repeat=3) if sum(p) <= degree
                and all(n % 2 == w for n, w in zip(p, wanted))]
        basis = np.array(basis)
        component, powers = basis[:, 0], basis[:, 1:]

        def integral(i, j):
            """Of df/dx_i dg/dx_j over the box, None being no derivative, for
            all pairs of products of polynomials."""
            total = 1.0
            for axis in range(3):
                n = powers[:, axis]
                total = total * (table[i == axis][j == axis][np.ix_(n, n)]
                                 * half[axis]
                                 / half[axis]**((i == axis) + (j == axis)))
            return total

        both = np.equal.outer(component, component)
        mass = np.where(both, rho * integral(None, None), 0)
        gradient = sum(integral(i, i) for i in range(3))
        stiffness = np.where(both, mu * gradient, 0)
        for i, j in itertools.product(range(3), repeat=2):
            pair = np.outer(component == i, component == j)
            # lambda div u div v + mu du_i/dx_j dv_j/dx_i
            stiffness += pair * (lam * integral(i, j) + mu * integral(j, i))
        squares = scipy.linalg.eigh(stiffness, mass, eigvals_only=True)
        found += [(np.sqrt(s) / 2 / np.pi, parity) for s in squares
                  if s > 1e-6 * squares[-1] / degree**4]
    return sorted(found)


def main():
    # Lame's mode of a cube is among those found
    cube = [f for f, _ in frequencies((1.0, 1.0, 1.0))]
    lame = np.sqrt(2) / 2 * np.sqrt(E / 2 / (1 + NU) / RHO)
    print("Lame's mode of a cube: %.1e" % (np.min(np.abs(cube - lame)) / lame))
    modes = frequencies()[:len(HISTORIES)]
    lower = frequencies(degree=DEGREE - 2)[:len(HISTORIES)]
    print("change by the last two degrees: %.1e" % max(
        abs(a[0] / b[0] - 1) for a, b in zip(modes, lower)))
    with open(os.path.join(HERE, "frequencies.csv"), "w") as stream:
        stream.write("frequency [Hz]\n")
        for frequency, _ in modes:
            stream.write("%.9g\n" % frequency)


if __name__ == "__main__":
    main()
