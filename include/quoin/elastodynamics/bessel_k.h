// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_bessel_k_h
#define quoin_elastodynamics_bessel_k_h

#include <complex>

namespace quoin
{
  /** Modified Bessel functions of the second kind at one argument z. */
  struct BesselK
  {
    std::complex<double> K0;
    std::complex<double> K1;
    /** (K_1(z) - 1/z) / z, free of cancellation for small z. */
    std::complex<double> K1_regular;
  };

  /**
   * K_0 and K_1 for Re z >= 0, z != 0, to a relative error of 1e-13; zero
   * where they underflow.
   *
   * Power series (@cite DLMF, 10.31) for |z| < 2; from there to |z| = 18 the
   * integral
   * @f[ K_\nu(z) = \frac{\sqrt{\pi / 2z}\, e^{-z}}{\Gamma(\nu + 1/2)}
   *     \int_{-\infty}^\infty e^{-x^2} x^{2\nu}
   *     \Bigl(1 + \frac{x^2}{2z}\Bigr)^{\nu - 1/2} dx @f]
   * (10.32.8 with t = 1 + x^2 / z) by the trapezoidal rule, which converges
   * exponentially; beyond, the asymptotic series (10.40.2).
   */
  BesselK bessel_k(std::complex<double> z);
} // namespace quoin

#endif
