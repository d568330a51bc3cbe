// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// The means over elements that the Galerkin scheme needs, against adaptive
// quadrature between all kinks, by the distance of the two elements.

#include <quoin/tdbem/element_integrals.h>
#include <quoin/tdbem/influence_matrices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "adaptive_quadrature.h"

using namespace quoin;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2., 2.5, 0.25);

  double distance(const dealii::Point<2> &x, const BoundaryElement &e)
  {
    const double s = std::clamp((x - e.a) * e.tangent(), 0., e.length());
    return (x - e.a - s * e.tangent()).norm();
  }

  double distance(const BoundaryElement &e, const BoundaryElement &f)
  {
    return std::min({ distance(e.a, f), distance(e.b, f), distance(f.a, e),
                      distance(f.b, e) });
  }

  /**
   * Places in (0, 1) on @p outer where the integral over @p inner has a kink:
   * the feet of its ends, and where a front meets an end or touches it.
   */
  std::vector<double> kinks(const BoundaryElement &outer,
                            const BoundaryElement &inner, const double time)
  {
    std::vector<double> all;
    const double length = outer.length();
    for (const dealii::Point<2> &end : { inner.a, inner.b })
    {
      const double foot   = (end - outer.a) * outer.tangent();
      const double height = std::abs((end - outer.a) * outer.normal());
      all.push_back(foot);
      for (const double c : { medium.c1, medium.c2 })
        if (c * time > height)
        {
          const double half
              = std::sqrt((c * time - height) * (c * time + height));
          all.push_back(foot - half);
          all.push_back(foot + half);
        }
    }
    const double slope  = outer.tangent() * inner.normal();
    const double offset = (outer.a - inner.a) * inner.normal();
    if (std::abs(slope) > 1e-12)
      for (const double c : { medium.c1, medium.c2 })
      {
        all.push_back((c * time - offset) / slope);
        all.push_back((-c * time - offset) / slope);
      }
    std::vector<double> inside;
    for (const double place : all)
      if (place > 1e-10 * length && place < (1. - 1e-10) * length)
        inside.push_back(place / length);
    inside.push_back(0.);
    inside.push_back(1.);
    std::sort(inside.begin(), inside.end());
    return inside;
  }

  TimeKernels reference(const BoundaryElement &outer,
                        const BoundaryElement &inner, const double time,
                        const double tolerance, const bool touching)
  {
    TimeKernels sum{ Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero() };
    const std::vector<double> cuts = kinks(outer, inner, time);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      if (cuts[k + 1] - cuts[k] < 1e-13)
        continue;
      const TimeKernels part = integrate_adaptively(
          [&](const double s)
          {
            return element_integrals(medium, time,
                                     outer.a + s * (outer.b - outer.a), inner);
          },
          cuts[k], cuts[k + 1], tolerance,
          touching ? 28 : 8); // a logarithm at the common end
      sum.A += part.A;
      sum.B += part.B;
    }
    return sum;
  }

  struct Error
  {
    double A = 0., B = 0.;
  };

  /** By kind of pair, relative to the greatest entry at the same time. */
  std::map<std::string, Error> errors(const Boundary &boundary,
                                      const std::vector<double> &times,
                                      const unsigned every)
  {
    InfluenceMatrices::Options options;
    options.symmetrise = false;
    const InfluenceMatrices matrices(boundary, medium, 1., options);
    const auto norm
        = [](const auto &matrix) { return matrix.cwiseAbs().maxCoeff(); };
    std::map<std::string, Error> result;
    for (const double time : times)
    {
      const InfluenceMatrices::Integrals integrals = matrices.integrals(time);
      const double A = norm(integrals.A), B = norm(integrals.B);
      for (unsigned e = 0; e < boundary.n_elements(); e += every)
        for (unsigned f = 0; f < boundary.n_elements(); ++f)
        {
          const BoundaryElement &outer = boundary.elements[e];
          const BoundaryElement &inner = boundary.elements[f];
          const double nearest         = distance(outer, inner);
          if (medium.c1 * time <= nearest)
            continue;
          const double length = std::max(outer.length(), inner.length());
          const bool touching = nearest < 1e-9 * length;
          Error &error        = result[e == f                   ? "itself"
                                       : touching               ? "touching"
                                       : nearest < 1.6 * length ? "near"
                                                                : "far"];
          const TimeKernels exact
              = reference(outer, inner, time, 1e-13 * std::min(A, B), touching);
          error.A = std::max(error.A, norm(integrals.A.block<2, 2>(2 * e, 2 * f)
                                           - exact.A.transpose())
                                          / A);
          // Of an element on itself it is a principal value, zero.
          error.B = std::max(
              error.B, e == f ? norm(integrals.B.block<2, 2>(2 * e, 2 * e))
                              : norm(integrals.B.block<2, 2>(2 * e, 2 * f)
                                     - exact.B.transpose())
                                    / B);
        }
    }
    return result;
  }
} // namespace

TEST(OuterIntegrals, agree_with_adaptive_quadrature)
{
  // Elements of different lengths, acute and obtuse corners; a polygon.
  const Boundary wedge = Boundary::polygon(
      { { 0., 0. }, { 1., 0. }, { 1.2, 0.7 }, { 0.1, 0.25 } }, 0.15, false);
  const Boundary circle = Boundary::circle({ 0., 0. }, 0.6, 24, true);
  const std::vector<double> times
      = { 0.03, 0.085, 0.12, 0.21, 0.34, 0.61, 1.1, 2.6, 25. };
  auto worst = errors(wedge, times, 2);
  for (const auto &[kind, error] : errors(circle, times, 24))
  {
    worst[kind].A = std::max(worst[kind].A, error.A);
    worst[kind].B = std::max(worst[kind].B, error.B);
  }
  ASSERT_EQ(worst.size(), 4u);
  EXPECT_LT(worst["itself"].A, 1e-10);
  EXPECT_EQ(worst["itself"].B, 0.);
  EXPECT_LT(worst["touching"].A, 1e-10);
  EXPECT_LT(worst["touching"].B, 1e-10);
  EXPECT_LT(worst["near"].A, 1e-10);
  EXPECT_LT(worst["near"].B, 1e-10);
  // Regular integrals.
  EXPECT_LT(worst["far"].A, 5e-8);
  EXPECT_LT(worst["far"].B, 5e-7);
}
