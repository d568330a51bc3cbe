// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/elastodynamics/bessel_k.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using Complex = std::complex<double>;

  /**
   * K_nu(z) = 1/2 int exp(-z cosh t + nu t) dt by the trapezoidal rule on the
   * path t = tau - i arg(z) tanh(tau), on which the integrand decays at both
   * ends without turning.
   */
  Complex reference(const double nu, const Complex z)
  {
    const double angle = std::arg(z), h = 1. / 80.;
    Complex sum = 0.;
    for (int k = -1600; k <= 1600; ++k)
    {
      const double tau = k * h, tanh = std::tanh(tau);
      const Complex t(tau, -angle * tanh);
      const Complex slope(1., -angle * (1. - tanh * tanh));
      const Complex exponent = -z * std::cosh(t) + nu * t;
      if (exponent.real() > -700.)
        sum += 0.5 * h * slope * std::exp(exponent);
    }
    return sum;
  }
} // namespace

TEST(BesselK, agrees_with_integral_in_right_half_plane)
{
  double worst = 0.;
  for (const double size : { 1e-3, 0.1, 0.7, 1.99, 2.01, 3.5, 7.99, 8.01, 12.,
                             17.9, 18.1, 30., 80. })
    for (const double angle : { -0.5, -0.4, -0.2, 0., 0.1, 0.3, 0.49, 0.5 })
    {
      const Complex z  = std::polar(size, angle * 3.14159265358979323846);
      const auto K     = quoin::bessel_k(z);
      const Complex K0 = reference(0., z), K1 = reference(1., z);
      const double error
          = std::max(std::abs(K.K0 / K0 - 1.), std::abs(K.K1 / K1 - 1.));
      EXPECT_LT(error, 1e-13) << z;
      worst = std::max(worst, error);
    }
  RecordProperty("worst_error", testing::PrintToString(worst));
}

// Abramowitz and Stegun, tables 9.8 and 9.9.
TEST(BesselK, agrees_with_tables)
{
  EXPECT_NEAR(quoin::bessel_k(1.).K0.real(), 0.4210244382407083, 1e-15);
  EXPECT_NEAR(quoin::bessel_k(1.).K1.real(), 0.6019072301972346, 1e-15);
  EXPECT_NEAR(quoin::bessel_k(5.).K0.real(), 3.691098334042594e-3, 1e-17);
  EXPECT_NEAR(quoin::bessel_k(5.).K1.real(), 4.044613445452164e-3, 1e-17);
}

TEST(BesselK, regular_part_has_no_cancellation)
{
  constexpr double gamma = 0.57721566490153286;
  for (const double size : { 1e-8, 1e-5, 1e-3 })
  {
    const Complex z = std::polar(size, 1.2);
    // The first two terms of the power series.
    const Complex series = (0.5 + z * z / 16.) * std::log(0.5 * z)
                           - 0.25 * (1. - 2. * gamma)
                           - z * z / 32. * (2.5 - 2. * gamma);
    EXPECT_LT(std::abs(quoin::bessel_k(z).K1_regular / series - 1.),
              1e-14 + size * size * size * size);
  }
}

// K_0 at neighbouring points on both sides of each change of method.
TEST(BesselK, methods_join)
{
  for (const double size : { 2., 8., 18. })
    for (const double angle : { 0., 0.7, 1.57 })
    {
      const Complex below = std::polar(size * (1. - 1e-9), angle);
      const Complex above = std::polar(size * (1. + 1e-9), angle);
      const auto b = quoin::bessel_k(below), a = quoin::bessel_k(above);
      // dK0/dz = -K1
      EXPECT_LT(std::abs(a.K0 - b.K0 + (above - below) * 0.5 * (a.K1 + b.K1)),
                1e-14 * std::abs(a.K0));
    }
}
