// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/elastodynamics/plane_wave.h>

#include <quoin/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace quoin
{
  PlaneWave::PlaneWave(const ElasticMedium &medium, const Type type,
                       const bool half_plane, const double angle,
                       std::function<double(double)> f,
                       const SignalRange &range)
    : PlaneWaveSum(medium, std::move(f))
  {
    const bool is_p        = type == Type::P;
    const double c1        = medium.c1;
    const double c2        = medium.c2;
    const double speed     = is_p ? c1 : c2;
    const double sine      = std::sin(angle);
    const double cosine    = std::cos(angle);
    const auto along       = Eigen::Vector2cd(sine, cosine);
    const auto transversal = Eigen::Vector2cd(cosine, -sine);
    std::vector<Component> waves{ { is_p ? along : transversal,
                                    along / speed } };
    if (half_plane)
    {
      // The tolerance is for angles that are meant to be exactly the limit.
      const double tolerance = 1e-9;
      if (!(cosine > tolerance))
        throw InputError(
            "Plane wave: in a half-plane the wave must come from below. Its "
            "angle from the upward vertical must be between -90 and 90 "
            "degrees.");

      // p is the slowness along the surface, e1 and e2 those of P and S waves
      // across it. Beyond the critical angle e1 is such that exp(i w (t + e1
      // y)) falls with depth.
      using Complex           = std::complex<double>;
      const double p          = sine / speed;
      const double e1_squared = 1. / (c1 * c1) - p * p;
      const bool clings       = e1_squared < -2. * tolerance / (c1 * c1);
      const Complex e1        = clings ? Complex(0., -std::sqrt(-e1_squared))
                                       : std::sqrt(std::max(0., e1_squared));
      const double e2         = std::sqrt(1. / (c2 * c2) - p * p);
      const double a          = 1. / (c2 * c2) - 2. * p * p;
      const Complex b         = 4. * p * p * e1 * e2;
      const Complex d         = a * a + b;

      const Complex reflected_p
          = is_p ? (b - a * a) / d : 4. * c2 / c1 * p * e2 * a / d;
      const Complex reflected_s
          = is_p ? 4. * c1 / c2 * p * e1 * a / d : (a * a - b) / d;
      waves.push_back({ reflected_p * c1 * Eigen::Vector2cd(p, -e1),
                        Eigen::Vector2cd(p, -e1) });
      waves.push_back({ reflected_s * c2 * Eigen::Vector2cd(e2, p),
                        Eigen::Vector2cd(p, -e2) });
    }
    set_components(std::move(waves), range);
  }
} // namespace quoin
