#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Circular cavity of radius a under a uniform pressure, by Laplace transform.

With s in units of c1/a, R = r/a, kappa = (1 - nu)/(1 - 2 nu) and the transform
P(s) of the pressure,

  2 mu u_r / a   = P K1(s R) / D,   D = K1(s) + kappa s K0(s),
  sigma_theta    = P [K1(s R)/R - (kappa - 1) s K0(s R)] / D

(Selberg 1952; Chou and Koenig 1966). K0 and K1 come from their integral over
exp(-z cosh t), the inverse from the Fourier series on a line in the right
half-plane with Euler's summation (Abate and Whitt 1995), counted from the
arrival of the wave, before which nothing moves.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RADIUS, DENSITY, YOUNG, NU, PRESSURE = 1.0, 2500.0, 18.75e9, 0.25, 1e6
MU = YOUNG / (2 * (1 + NU))
C1 = (2 * MU * (1 - NU) / (1 - 2 * NU) / DENSITY) ** 0.5
KAPPA = (1 - NU) / (1 - 2 * NU)
STEPS = 102  # of the case with 32 elements, up to c1 t/a = 20
STEPS_64 = 272  # of the one with 64 elements and c1 dt/L = 0.75


def bessel_k(z):
    """exp(z) K0(z) and exp(z) K1(z) by the trapezoidal rule."""
    z = np.asarray(z, dtype=complex)
    t = np.arange(0.0, 12.0, 0.004)
    weight = np.full(len(t), 0.004)
    weight[0] *= 0.5
    cosh = np.cosh(t)
    kernel = np.exp(-np.minimum(np.multiply.outer(z.real, cosh - 1), 700)
                    - 1j * np.multiply.outer(z.imag, cosh - 1))
    return kernel @ weight, kernel @ (weight * cosh)


def invert(transform, tau):
    """The function of time tau > 0 with this Laplace transform."""
    A, terms, averaged = 24.0, 60, 20
    k = np.arange(terms + averaged + 1)
    s = (0.5 * A + 1j * np.pi * k) / tau
    series = np.where(k % 2, -1.0, 1.0) * transform(s).real
    series[0] *= 0.5
    sums = np.cumsum(series)[terms:]
    binomial = np.ones(averaged + 1)
    for j in range(averaged):
        binomial[j + 1] = binomial[j] * (averaged - j) / (j + 1)
    return np.exp(0.5 * A) / tau * (sums @ binomial) / 2.0**averaged


def step(s):
    return 1 / s


def decaying(s):
    return 1 / (s + 1)


def quantities(pressure, R, tau):
    """2 mu u/(p a) and sigma_theta/p at r = R a and the times tau."""
    result = np.zeros((len(tau), 2))
    for row, t in zip(result, tau - (R - 1)):
        if t <= 0:
            continue

        def parts(s):
            # exp(-s (R - 1)), the delay, is left out
            K0, K1 = bessel_k(s)
            K0R, K1R = bessel_k(s * R)
            D = K1 + KAPPA * s * K0
            return pressure(s) * np.array([K1R, K1R / R
                                           - (KAPPA - 1) * s * K0R]) / D

        row[:] = [invert(lambda s: parts(s)[q], t) for q in (0, 1)]
    return result


def write(name, header, *columns):
    np.savetxt(os.path.join(HERE, name), np.transpose(columns), delimiter=",",
               fmt="%.9g", comments="", header=header)


def main():
    displacement = PRESSURE * RADIUS / (2 * MU)
    header = "time [s],u_wall [m],hoop [Pa],u_inside [m]"
    # Tabulated values of a step: the inversion has to give them.
    check = quantities(step, 1.0, np.array([0.5, 4.0, 20.0]))
    known = [[0.315403, 0.087203], [1.191099, 1.254799], [1.003758, 1.005011]]
    assert np.abs(check - known).max() < 1e-6, check

    for name, pressure, steps in (
            ("reference.csv", step, STEPS),
            ("reference_decay.csv", decaying, STEPS),
            ("reference_decay_64.csv", decaying, STEPS_64)):
        tau = 20.0 * np.arange(1, steps + 1) / steps
        wall = quantities(pressure, 1.0, tau)
        inside = quantities(pressure, 2.0, tau)
        write(name, header, tau * RADIUS / C1, displacement * wall[:, 0],
              PRESSURE * wall[:, 1], displacement * inside[:, 0])

    tau = 20.0 * np.arange(1, 25 * STEPS + 1, 5) / STEPS
    wall = quantities(step, 1.0, tau)
    write("reference_long.csv", "time [s],u_wall [m],hoop [Pa]",
          tau * RADIUS / C1, displacement * wall[:, 0], PRESSURE * wall[:, 1])

    # The motion of the wall and, at a point of it, the traction it needs.
    tau = np.arange(0.0, 20.1, 0.02)
    wall = quantities(step, 1.0, tau)
    write("wall_motion.csv", "time [s],displacement [m]", tau * RADIUS / C1,
          displacement * wall[:, 0])
    tau = 20.0 * np.arange(1, STEPS + 1) / STEPS
    wall = quantities(step, 1.0, tau)
    write("reference_motion.csv", "time [s],u_wall [m],hoop [Pa],traction [Pa]",
          tau * RADIUS / C1, displacement * wall[:, 0], PRESSURE * wall[:, 1],
          np.full(STEPS, PRESSURE))


if __name__ == "__main__":
    main()
