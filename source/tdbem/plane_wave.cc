// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/plane_wave.h>

#include <quoin/base/exceptions.h>
#include <quoin/tdbem/gauss_legendre.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace quoin
{
  namespace
  {
    /** The mean of @p value(x, n) over each element. */
    template <typename Function>
    Eigen::VectorXd element_means(const Boundary &boundary,
                                  const Function &value)
    {
      const GaussRule &rule  = gauss_legendre(4);
      Eigen::VectorXd result = Eigen::VectorXd::Zero(boundary.n_unknowns());
      for (std::size_t e = 0; e < boundary.n_elements(); ++e)
      {
        const BoundaryElement &element = boundary.elements[e];
        const Eigen::Vector2d normal   = element.normal();
        for (std::size_t g = 0; g < rule.points.size(); ++g)
        {
          const Eigen::Vector2d x
              = element.a + rule.points[g] * (element.b - element.a);
          result.segment<2>(2 * e) += rule.weights[g] * value(x, normal);
        }
      }
      return result;
    }
  } // namespace

  PlaneWave::PlaneWave(const ElasticMedium &medium, const Type type,
                       const bool half_plane, const double angle,
                       std::function<double(double)> f)
    : medium(medium), f(std::move(f))
  {
    const bool is_p        = type == Type::P;
    const double c1        = medium.c1;
    const double c2        = medium.c2;
    const double speed     = is_p ? c1 : c2;
    const double sine      = std::sin(angle);
    const double cosine    = std::cos(angle);
    const auto along       = Eigen::Vector2d(sine, cosine);
    const auto transversal = Eigen::Vector2d(cosine, -sine);
    waves.push_back({ is_p ? along : transversal, along / speed });
    if (!half_plane)
      return;

    // The tolerance is for angles that are meant to be exactly the limit.
    const double tolerance = 1e-9;
    if (!(cosine > tolerance))
      throw InputError(
          "Plane wave: in a half-plane the wave must come from below. Its "
          "angle from the upward vertical must be between -90 and 90 degrees.");
    if (!is_p && std::abs(sine) > c2 / c1 * (1. + tolerance))
      throw InputError(
          "Plane wave: an SV wave must not come at more than the critical "
          "angle, here "
          + std::to_string(std::asin(c2 / c1) * 180. / M_PI)
          + " degrees. Beyond it the reflection is complex: the reflected "
            "signals contain the Hilbert transform of the incident one, which "
            "is not available.");

    // p is the slowness along the surface, e1 and e2 those of P and S waves
    // across it.
    const double p  = sine / speed;
    const double e1 = std::sqrt(std::max(0., 1. / (c1 * c1) - p * p));
    const double e2 = std::sqrt(1. / (c2 * c2) - p * p);
    const double a  = 1. / (c2 * c2) - 2. * p * p;
    const double b  = 4. * p * p * e1 * e2;
    const double d  = a * a + b;

    const double reflected_p
        = is_p ? (b - a * a) / d : 4. * c2 / c1 * p * e2 * a / d;
    const double reflected_s
        = is_p ? 4. * c1 / c2 * p * e1 * a / d : (a * a - b) / d;
    waves.push_back({ reflected_p * c1 * Eigen::Vector2d(p, -e1), { p, -e1 } });
    waves.push_back({ reflected_s * c2 * Eigen::Vector2d(e2, p), { p, -e2 } });
  }

  Eigen::Vector2d PlaneWave::displacement(const Eigen::Vector2d &x,
                                          const double t) const
  {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Component &wave : waves)
      sum += wave.amplitude * f(t - wave.slowness.dot(x));
    return sum;
  }

  Eigen::Vector2d PlaneWave::mean_traction(const Eigen::Vector2d &x,
                                           const Eigen::Vector2d &n,
                                           const double t0,
                                           const double t1) const
  {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Component &wave : waves)
    {
      const Eigen::Vector2d &d = wave.amplitude;
      const Eigen::Vector2d &s = wave.slowness;
      // The displacement gradient is -d s f'.
      const double delay = s.dot(x);
      const double rate  = (f(t1 - delay) - f(t0 - delay)) / (t1 - t0);
      sum -= rate
             * (medium.lambda() * d.dot(s) * n
                + medium.mu() * (s.dot(n) * d + d.dot(n) * s));
    }
    return sum;
  }

  Eigen::VectorXd PlaneWave::displacements(const Boundary &boundary,
                                           const double t) const
  {
    return element_means(boundary,
                         [&](const Eigen::Vector2d &x, const Eigen::Vector2d &)
                         { return displacement(x, t); });
  }

  Eigen::VectorXd PlaneWave::mean_tractions(const Boundary &boundary,
                                            const double t0,
                                            const double t1) const
  {
    return element_means(boundary,
                         [&](const Eigen::Vector2d &x, const Eigen::Vector2d &n)
                         { return mean_traction(x, n, t0, t1); });
  }
} // namespace quoin
