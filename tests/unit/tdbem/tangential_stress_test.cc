// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "cavity.h"

#include <quoin/base/eigen_vectors.h>
#include <quoin/tdbem/static_solver.h>
#include <quoin/tdbem/tangential_stress.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  using Eigen::Matrix2d;

  const ElasticMedium medium{ 2., 3., 1.5 };

  /** Stress of a uniform displacement gradient. */
  Matrix2d stress(const Matrix2d &gradient)
  {
    const Matrix2d strain = 0.5 * (gradient + gradient.transpose());
    return medium.lambda() * strain.trace() * Matrix2d::Identity()
           + 2. * medium.mu() * strain;
  }

  void expect_uniform(const Boundary &boundary)
  {
    Matrix2d gradient;
    gradient << 0.3, 0.5, -0.2, 0.1;
    const unsigned n = unsigned(boundary.n_unknowns());
    Eigen::VectorXd u(n), p(n);
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
    {
      const auto &element = boundary.elements[e];
      u.segment<2>(2 * e)
          = Eigen::Vector2d(1., 2.) + gradient * to_eigen(element.middle());
      p.segment<2>(2 * e) = stress(gradient) * to_eigen(element.normal());
    }
    const Eigen::VectorXd computed = TangentialStress(boundary, medium)(u, p);
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
    {
      const auto t = to_eigen(boundary.elements[e].tangent());
      EXPECT_NEAR(computed[e], t.dot(stress(gradient) * t), 1e-11) << e;
    }
  }
} // namespace

TEST(TangentialStress, UniformStrainOnPolygons)
{
  expect_uniform(Boundary::polygon(
      { { 0., 0. }, { 2., 0. }, { 1., 1. }, { 0., 1. } }, 0.3, true));
  // Two elements a side: from one to the next.
  expect_uniform(Boundary::polygon(
      { { 0., 0. }, { 2., 0. }, { 2., 2. }, { 0., 2. } }, 1., false));
}

TEST(TangentialStress, UniformStrainOnOpenLines)
{
  Boundary boundary;
  boundary.add_curve({ { -4., -2. }, { -2., -1. }, { -1., -0.5 }, { 0., 0. } },
                     false);
  boundary.add_curve({ { 0., 0. }, { 1., 0.5 } }, false);
  expect_uniform(boundary);
}

TEST(TangentialStress, QuadraticOnALine)
{
  // Unequal elements: exact for displacements that are quadratic in place.
  Boundary boundary;
  boundary.add_curve({ { 0., 0. }, { 1., 0. }, { 1.5, 0. }, { 3., 0. } },
                     false);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6), p = u;
  for (unsigned e = 0; e < 3; ++e)
    u[2 * e] = std::pow(boundary.elements[e].middle()[0], 2);
  const auto computed  = TangentialStress(boundary, medium)(u, p);
  const double modulus = 4. * medium.mu() * (medium.lambda() + medium.mu())
                         / (medium.lambda() + 2. * medium.mu());
  for (unsigned e = 0; e < 3; ++e)
    EXPECT_NEAR(computed[e], 2. * boundary.elements[e].middle()[0] * modulus,
                1e-12);
}

TEST(TangentialStress, RadialMotionOfACircle)
{
  // u / a with the circle of the same length.
  const double modulus = 4. * medium.mu() * (medium.lambda() + medium.mu())
                         / (medium.lambda() + 2. * medium.mu());
  for (const bool exterior : { false, true })
  {
    const unsigned n        = 32;
    const Boundary boundary = Boundary::circle({ 1., 2. }, 3., n, exterior);
    const double radius     = boundary.lengths().sum() / (2. * std::acos(-1.));
    Eigen::VectorXd p       = test::unit_pressure(boundary);
    const auto computed
        = TangentialStress(boundary, medium)(exterior ? p : -p, 0. * p);
    for (unsigned e = 0; e < n; ++e)
      EXPECT_NEAR(computed[e] * radius / modulus, 1., 2e-5);
  }
}

TEST(TangentialStress, StaticCavity)
{
  const Boundary boundary = test::cavity(1., 32);
  StaticConditions conditions;
  conditions.values = test::unit_pressure(boundary);
  conditions.displacement_known.assign(boundary.n_unknowns(), false);
  const auto solution
      = solve_static(boundary, medium, Projection::galerkin, conditions);
  const auto computed = TangentialStress(boundary, medium)(
      solution.displacement, solution.traction);
  for (unsigned e = 0; e < 32; ++e)
    EXPECT_NEAR(computed[e], 1., 1e-3);
}
