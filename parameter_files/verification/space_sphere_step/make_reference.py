#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Spherical cavity of radius a under a step of pressure p in an unbounded medium.

The potential f(tau)/r of the displacement, tau = t - (r - a)/c1, is a spherical P
wave. In units of a and c1, with m = mu/(lambda + 2 mu), the radial stress
(lambda + 2 mu) f''/r + 4 mu (f'/r^2 + f/r^3) is -p on the wall, so that

  f'' + 4 m f' + 4 m f = -p/(lambda + 2 mu),   u = -(f'/r + f/r^2).
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RADIUS, DENSITY, YOUNG, NU, PRESSURE = 1.0, 2500.0, 18.75e9, 0.25, 1e6
MU = YOUNG / (2 * (1 + NU))
RATIO = (1 - 2 * NU) / (2 * (1 - NU))
C1 = (MU / RATIO / DENSITY)**0.5
DECAY = 2 * RATIO
OMEGA = (4 * RATIO - DECAY**2)**0.5


def potential(tau):
    """f, f' and f'', in units of p a^3/(4 mu)."""
    e, c, s = np.exp(-DECAY * tau), np.cos(OMEGA * tau), np.sin(OMEGA * tau)
    slope = -e * s * (DECAY**2 + OMEGA**2) / OMEGA
    return np.array([-(1 - e * (c + DECAY / OMEGA * s)), slope,
                     -DECAY * slope - e * c * (DECAY**2 + OMEGA**2)])


def displacement(r, t):
    """Radial displacement [m] at the distance r [m] and the time t [s]."""
    r = np.asarray(r) / RADIUS
    tau = t * C1 / RADIUS - (r - 1)
    f, slope, _ = potential(np.maximum(tau, 0))
    return (-(slope / r + f / r**2) * (tau > 0)
            * PRESSURE * RADIUS / (4 * MU))


def stresses(r, t):
    """Radial stress and hoop stress [Pa] at the distance r [m]."""
    r = np.asarray(r) / RADIUS
    tau = t * C1 / RADIUS - (r - 1)
    f, slope, second = potential(np.maximum(tau, 0)) * (tau > 0)
    along = second / r + 2 * slope / r**2 + 2 * f / r**3      # du/dr
    across = -(slope / r**2 + f / r**3)                       # u/r
    lame = (1 / RATIO - 2) * MU
    return PRESSURE / (4 * MU) * np.array([
        (lame + 2 * MU) * along + 2 * lame * across,
        lame * along + 2 * (lame + MU) * across])


def peak():
    """Largest displacement of the wall [m] and its time [s]."""
    tau = np.linspace(1.5, 2.5, 100001) * RADIUS / C1
    u = displacement(1, tau)
    return np.max(u), tau[np.argmax(u)]


def main():
    largest, time = peak()
    assert abs(largest / (PRESSURE * RADIUS / (4 * MU)) - 1.258976) < 1e-6
    assert abs(time * C1 / RADIUS - 2.0265) < 1e-4
    tau = np.linspace(0, 20, 20001)
    f, slope, second = potential(tau)
    assert np.allclose(np.gradient(f, tau)[1:-1], slope[1:-1], atol=1e-6)
    assert np.allclose(second + 4 * RATIO * (slope + f), -4 * RATIO)
    late = np.array([0.3, 1.0, 3.0]) * RADIUS / C1
    assert np.allclose([stresses(1, t)[0] for t in late], -PRESSURE)
    # the hoop stress of the static cavity is half of the pressure
    assert np.allclose(stresses(1, 0.1), [-PRESSURE, PRESSURE / 2])
    # equilibrium: s_rr' + 2 (s_rr - s_tt)/r = rho u'' at 1.5 m and c1 t/a = 3
    r, t, d, e = 1.5, 3 * RADIUS / C1, 1e-4, 1e-7
    slope_r = (stresses(r + d, t) - stresses(r - d, t))[0] / (2 * d)
    force = slope_r + 2 * (stresses(r, t)[0] - stresses(r, t)[1]) / r
    inertia = DENSITY * (displacement(r, t + e) - 2 * displacement(r, t)
                         + displacement(r, t - e)) / e**2
    assert abs(force / inertia - 1) < 1e-3
    # Lame's static cavity, p a/(4 mu), in the end
    assert abs(displacement(1, 0.1) / (PRESSURE / (4 * MU)) - 1) < 1e-6
    for name, end in (("reference.csv", 8), ("reference_far.csv", 10)):
        times = np.arange(0, end + 0.001, 0.05) * RADIUS / C1
        wall = displacement(1, times)
        np.savetxt(os.path.join(HERE, name),
                   np.transpose([times, wall, wall, displacement(2, times)]),
                   delimiter=",", fmt="%.9g", comments="",
                   header="time [s],wall_x [m],wall_z [m],inner_y [m]")
    hoop = np.array([stresses(1, t)[1] for t in tau * RADIUS / C1])
    print("hoop stress at the wall from %.4g to %.4g of the pressure, at c1 t/a "
          "= %.3g" % (hoop[1] / PRESSURE, np.max(hoop) / PRESSURE,
                      tau[np.argmax(hoop)]))
    print("peak of the wall %.6g of the static displacement, at c1 t/a = %.5g"
          % (largest / (PRESSURE * RADIUS / (4 * MU)), time * C1 / RADIUS))


if __name__ == "__main__":
    main()
