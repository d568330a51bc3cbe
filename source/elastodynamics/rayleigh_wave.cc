// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/elastodynamics/rayleigh_wave.h>

#include <boost/math/tools/roots.hpp>

#include <cmath>
#include <complex>
#include <utility>

namespace quoin
{
  double rayleigh_speed(const ElasticMedium &medium)
  {
    // In terms of the square of the speed by c2; negative between 0 and the
    // root, positive up to 1.
    const double ratio  = medium.c2 * medium.c2 / (medium.c1 * medium.c1);
    const auto equation = [ratio](const double square)
    {
      return (2. - square) * (2. - square)
             - 4. * std::sqrt((1. - square) * (1. - ratio * square));
    };
    const auto [low, high] = boost::math::tools::bisect(
        equation, 0.3, 1., boost::math::tools::eps_tolerance<double>(50));
    return medium.c2 * std::sqrt(0.5 * (low + high));
  }

  RayleighWave::RayleighWave(const ElasticMedium &medium, const bool to_right,
                             std::function<double(double)> f,
                             const SignalRange &range)
    : PlaneWaveSum(medium, std::move(f))
  {
    const std::complex<double> i(0., 1.);
    const double q1 = 1. / (medium.c1 * medium.c1);
    const double q2 = 1. / (medium.c2 * medium.c2);
    const double p  = (to_right ? 1. : -1.) / rayleigh_speed(medium);
    const double g1 = std::sqrt(p * p - q1);
    const double g2 = std::sqrt(p * p - q2);
    // The coefficient of P makes the vertical displacement f, that of SV
    // cancels the shear stress on the surface; Rayleigh's equation cancels the
    // normal stress.
    const std::complex<double> of_p = i * (2. * p * p - q2) / (g1 * q2);
    const std::complex<double> of_s
        = of_p * i * (2. * p * g1) / (2. * p * p - q2);
    set_components(
        { { of_p * Eigen::Vector2cd(p, i * g1), Eigen::Vector2cd(p, i * g1) },
          { of_s * Eigen::Vector2cd(i * g2, -p),
            Eigen::Vector2cd(p, i * g2) } },
        range);
  }
} // namespace quoin
