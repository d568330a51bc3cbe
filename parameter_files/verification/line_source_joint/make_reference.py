#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The quoin authors
"""Slip of a frictionless joint beside an explosive line source (Day 1985).

A line source of the moment m0 H(t) at the distance h from a plane without
shear strength that cannot open makes the slip

  du = 2 m0 beta^2 / (pi rho alpha^2) Re[p eta_a eta_b / R(p)]
       (t^2 - r^2 / alpha^2)^(-1/2),   t > r / alpha,
  p = (t x + i h sqrt(t^2 - r^2 / alpha^2)) / r^2,   r^2 = x^2 + h^2,
  eta_c = sqrt(c^-2 - p^2),
  R(p) = (1 - 2 beta^2 p^2)^2 + 4 beta^4 p^2 eta_a eta_b.

A cavity of the radius a0 under the pressure P(s) (Laplace transform) sends the
waves of a line source with the moment

  M(s) = pi a0^2 (lambda + 2 mu) / mu * P(s) / (z K1(z) + kappa z^2 K0(z)),
  z = s a0 / alpha,  kappa = alpha^2 / (2 beta^2)

(Selberg 1952: the quotient of both fields). The slip is that of the step
convolved with dM/dt.
"""
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
H, A0, PRESSURE, RISE = 1.0, 0.1, 1e6, 5e-4
DENSITY, YOUNG, NU = 2500.0, 18.75e9, 0.25
MU = YOUNG / (2 * (1 + NU))
ALPHA = (2 * MU * (1 - NU) / (1 - 2 * NU) / DENSITY) ** 0.5
BETA = (MU / DENSITY) ** 0.5
MODULUS = DENSITY * ALPHA**2
END = 2.2e-3
POINTS = (0.5, 1.0, 1.5)


def step_slip(x, s):
    """Slip by m0 at the times sqrt(s^2 + r^2 / alpha^2), times s."""
    r = np.hypot(x, H)
    t = np.sqrt(s**2 + (r / ALPHA)**2)
    p = (t * x + 1j * H * s) / r**2
    eta_a, eta_b = np.sqrt(ALPHA**-2 - p**2), np.sqrt(BETA**-2 - p**2)
    rayleigh = ((1 - 2 * BETA**2 * p**2)**2
                + 4 * BETA**4 * p**2 * eta_a * eta_b)
    return (2 * BETA**2 / (np.pi * DENSITY * ALPHA**2)
            * (p * eta_a * eta_b / rayleigh).real)


def bessel_k(z):
    """K0(z) and K1(z) by the trapezoidal rule."""
    u = np.arange(0.0, 12.0, 0.004)
    weight = np.full(len(u), 0.004)
    weight[0] *= 0.5
    cosh = np.cosh(u)
    kernel = np.exp(-np.minimum(np.multiply.outer(z.real, cosh), 700)
                    - 1j * np.multiply.outer(z.imag, cosh))
    return kernel @ weight, kernel @ (weight * cosh)


def moment_rate(t):
    """dM/dt of the cavity's pressure, which rises like (1 - cos)/2 in RISE,
    from t = 0 in equal steps, by Fourier's series on a line Re s > 0."""
    n, dt = len(t), t[1] - t[0]
    period = 2 * n * dt
    shift = 16 / period
    k = np.arange(n + 1)
    s = shift + 2j * np.pi * k / period
    w = np.pi / RISE
    # s P(s): the transform of the rate of the pressure
    rate = 0.5 * w**2 / (s**2 + w**2) * (1 + np.exp(-s * RISE)) * PRESSURE
    z = s * A0 / ALPHA
    K0, K1 = bessel_k(z)
    kappa = ALPHA**2 / (2 * BETA**2)
    # exp(z), the delay of the front on its way from the centre to the wall
    moment = (np.pi * A0**2 * MODULUS / MU * rate * np.exp(-z)
              / (z * K1 + kappa * z**2 * K0))
    series = np.fft.irfft(moment, 2 * n)[:n] / dt
    return series * np.exp(shift * t)


def slip(x, times):
    """Slip of the cavity's pressure at these times."""
    dt = 1e-6
    t = dt * np.arange(int(END / dt) + 2)
    # exp(-z) above: this time counts from the wall's a0 / alpha later
    rate = moment_rate(t)
    arrival = np.hypot(x, H) / ALPHA
    # t' = sqrt(s^2 + arrival^2) takes the root's singularity away
    result = np.zeros(len(times))
    for i, now in enumerate(times + A0 / ALPHA):
        if now <= arrival:
            continue
        s = np.linspace(0, np.sqrt(now**2 - arrival**2), 4001)
        after = np.sqrt(s**2 + arrival**2)
        values = (step_slip(x, s) / after
                  * np.interp(now - after, t, rate, left=0))
        result[i] = np.trapezoid(values, s) if hasattr(np, "trapezoid") \
            else np.trapz(values, s)
    return result


def main():
    # Known values at x = h: 4 h rho beta^2 du / m0.
    t = np.array([1, 1.2, 1.5, 2, 3, 4, 6, 10]) * H / BETA
    s = np.sqrt(t**2 - 2 * (H / ALPHA)**2)
    check = 4 * H * DENSITY * BETA**2 * step_slip(H, s) / s
    known = [0.4468, 0.3862, 0.3716, 0.3630, 0.3442, 0.3339, 0.3255, 0.3209]
    assert np.abs(check - known).max() < 6e-5, check
    # and the static limit, x / (pi (lambda + mu) r^2)
    s = np.array([1e4 / BETA])
    static = H / (np.pi * 2 * MU * 2 * H**2)
    assert abs(step_slip(H, s)[0] / s[0] / static - 1) < 1e-3

    times = np.arange(2e-5, END, 2e-5)
    # The upper side, beyond the joint, lags behind: to the left, negative.
    columns = [times] + [-slip(x, times) for x in POINTS]
    print("final slip by its static limit:", -columns[2][-1]
          / (static * np.pi * A0**2 * MODULUS / MU * PRESSURE))
    np.savetxt(os.path.join(HERE, "reference.csv"), np.transpose(columns),
               delimiter=",", fmt="%.6g", comments="",
               header="time [s],slip_half [m],slip_one [m],slip_far [m]")


if __name__ == "__main__":
    main()
