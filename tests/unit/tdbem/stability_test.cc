// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/influence_matrices.h>

#include <gtest/gtest.h>

#include "regular_polygon.h"

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr unsigned n_sides = 24;

  ElasticMedium medium(const double poisson)
  {
    return ElasticMedium::from_young(1., 1., poisson);
  }

  Boundary polygon(const bool exterior)
  {
    return Boundary::circle({ 0., 0. }, 1., n_sides, exterior);
  }

  double time_step(const double beta, const double poisson)
  {
    return beta * polygon(true).elements[0].length() / medium(poisson).c1;
  }

  /** Roots that grow by more than 1 / 0.9995 in each step. */
  UnstableRoots time_stepping(const Projection projection, const double beta,
                              const double poisson, const bool exterior = true)
  {
    const Boundary boundary = polygon(exterior);
    InfluenceMatrices::Options options;
    options.projection = projection;
    const InfluenceMatrices kernel(boundary, medium(poisson),
                                   time_step(beta, poisson), options);
    return count_unstable_roots(PolygonSymbol(boundary, kernel, 300), n_sides,
                                0.9995, 100);
  }

  /** By more than 1 / 0.998. */
  UnstableRoots convolution_quadrature(const Projection projection,
                                       const double beta, const double poisson)
  {
    const Boundary boundary = polygon(true);
    const double dt         = time_step(beta, poisson);
    return count_unstable_roots(
        [&](const Complex w)
        {
          return convolution_quadrature_symbol(boundary, medium(poisson), dt,
                                               projection, w);
        },
        n_sides, 0.998, 40);
  }
} // namespace

/** Functions with known zeros, some a hair inside the circle or outside. */
TEST(Stability, counts_zeros)
{
  const auto symbol = [](const Complex w)
  {
    Determinants result{ Eigen::VectorXcd::Ones(3), Eigen::VectorXcd::Ones(3) };
    const auto pair = [&](const double radius, const double angle)
    {
      const Complex zero = std::polar(radius, angle);
      return (w - zero) * (w - std::conj(zero));
    };
    result.G(0) = (w - 0.3) * pair(0.9989, 0.8) * pair(0.9991, 0.8004);
    result.G(1) = pair(0.5, 1.) * pair(1.01, 1.1) * pair(1.5, 2.);
    result.H(1) = pair(0.9991, 1.);
    result.H(2) = (w + 0.998) * pair(0.9989, 2.) * pair(0.9988, 2.3);
    return result;
  };
  // Of four sides; the second mode counts for its mirror image, too.
  const UnstableRoots roots = count_unstable_roots(symbol, 4, 0.999, 20);
  EXPECT_EQ(roots.of_G, 3 + 2 * 2);
  EXPECT_EQ(roots.of_H, 5);
  EXPECT_LT(roots.n_evaluations, 400u);
}

/** From motion to traction the Galerkin scheme is stable for all steps. */
TEST(Stability, galerkin_from_motion_to_traction)
{
  for (const double poisson : { 0., 0.25, 0.4 })
    for (const double beta : { 0.3, 0.6, 1., 1.5 })
      // G is the same for both domains.
      EXPECT_EQ(time_stepping(Projection::galerkin, beta, poisson).of_G, 0)
          << "nu " << poisson << " beta " << beta;
}

/** From traction to motion it needs steps that are not too small. */
TEST(Stability, galerkin_from_traction_to_motion)
{
  for (const bool exterior : { true, false })
  {
    for (const double poisson : { 0., 0.25, 0.4 })
      EXPECT_EQ(time_stepping(Projection::galerkin, 1., poisson, exterior).of_H,
                0)
          << "nu " << poisson << " exterior " << exterior;
    EXPECT_GT(time_stepping(Projection::galerkin, 0.3, 0.25, exterior).of_H, 0);
  }
  EXPECT_EQ(time_stepping(Projection::galerkin, 0.6, 0.25).of_H, 0);
  EXPECT_GT(time_stepping(Projection::galerkin, 0.6, 0.4).of_H, 0);
}

/** The original scheme, for comparison: both ways, and worst for small steps.
 */
TEST(Stability, collocation)
{
  const UnstableRoots smallest
      = time_stepping(Projection::collocation, 0.3, 0.25);
  const UnstableRoots small = time_stepping(Projection::collocation, 0.6, 0.25);
  const UnstableRoots one   = time_stepping(Projection::collocation, 1., 0.25);
  EXPECT_GT(smallest.of_G, 50);
  EXPECT_GT(smallest.of_H, 50);
  EXPECT_GT(small.of_G, 0);
  EXPECT_GT(small.of_H, 10);
  EXPECT_EQ(one.of_G, 0);
  EXPECT_GT(one.of_H, 0);
  EXPECT_GT(time_stepping(Projection::collocation, 1., 0.4).of_G, 0);
}

TEST(Stability, convolution_quadrature)
{
  for (const double beta : { 0.3, 0.6, 1., 1.5 })
  {
    const UnstableRoots roots
        = convolution_quadrature(Projection::galerkin, beta, 0.25);
    EXPECT_EQ(roots.of_G, 0) << beta;
    EXPECT_EQ(roots.of_H, 0) << beta;
  }
  const UnstableRoots incompressible
      = convolution_quadrature(Projection::galerkin, 0.6, 0.4);
  EXPECT_EQ(incompressible.of_G, 0);
  EXPECT_EQ(incompressible.of_H, 0);

  const UnstableRoots collocation
      = convolution_quadrature(Projection::collocation, 0.3, 0.25);
  EXPECT_EQ(collocation.of_G, 0);
  EXPECT_GT(collocation.of_H, 0);
}
