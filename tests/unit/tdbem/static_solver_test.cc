// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/static_kernels.h>
#include <quoin/tdbem/static_solver.h>

#include "cavity.h"

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2000., 3e7, 0.25);

  StaticConditions all_tractions(const Eigen::VectorXd &p)
  {
    return { p, std::vector<bool>(p.size(), false), {} };
  }

  StaticConditions all_displacements(const Eigen::VectorXd &u)
  {
    return { u, std::vector<bool>(u.size(), true), {} };
  }

  Boundary square(const double element_length)
  {
    return Boundary::polygon({ { 0., 0. }, { 2., 0. }, { 2., 2. }, { 0., 2. } },
                             element_length, false);
  }

  /** Exact field of uniaxial tension sigma_xx = 1 Pa. */
  dealii::Point<2> tension_displacement(const dealii::Point<2> &x)
  {
    const double nu = medium.poisson();
    const double e  = 1. / (2. * medium.mu());
    return { (1. - nu) * e * x[0], -nu * e * x[1] };
  }

  Eigen::VectorXd tension_displacement(const Boundary &boundary)
  {
    Eigen::VectorXd u(boundary.n_unknowns());
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
      set_vector<2>(u, e, tension_displacement(boundary.elements[e].middle()));
    return u;
  }

  Eigen::VectorXd tension_traction(const Boundary &boundary)
  {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(boundary.n_unknowns());
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
      p(2 * e) = boundary.elements[e].normal()[0];
    return p;
  }

  double relative(const Eigen::VectorXd &value,
                  const Eigen::VectorXd &reference)
  {
    return (value - reference).norm() / reference.norm();
  }
} // namespace

class StaticSolver : public testing::TestWithParam<Projection>
{
};

INSTANTIATE_TEST_SUITE_P(Both, StaticSolver,
                         testing::Values(Projection::collocation,
                                         Projection::galerkin));

// 2 mu u / (p a) = 1.
TEST_P(StaticSolver, pressurised_cavity)
{
  double error[2];
  for (const unsigned level : { 0u, 1u })
  {
    const Boundary boundary = test::cavity(1.5, level == 0 ? 32 : 64);
    const StaticSolution solution
        = solve_static(boundary, medium, GetParam(),
                       all_tractions(test::unit_pressure(boundary)));
    error[level] = test::radial_displacement(boundary, solution.displacement)
                       * 2. * medium.mu() / 1.5
                   - 1.;
  }
  const bool galerkin = GetParam() == Projection::galerkin;
  EXPECT_LT(std::abs(error[0]), galerkin ? 2e-3 : 0.03);
  EXPECT_LT(std::abs(error[1]), 0.55 * std::abs(error[0]));
}

TEST_P(StaticSolver, pushed_cavity)
{
  const Boundary boundary = test::cavity(1.5, 48);
  const Eigen::VectorXd p = test::unit_pressure(boundary);
  const auto solution     = solve_static(
          boundary, medium, GetParam(),
          all_displacements(1.5 / (2. * medium.mu()) * p
                            + Eigen::VectorXd::Constant(p.size(), 2e-8)));
  // A translation of everything costs nothing.
  EXPECT_LT(relative(solution.traction, p),
            GetParam() == Projection::galerkin ? 1e-3 : 0.02);
  EXPECT_LT((solution.constant - dealii::Point<2>(2e-8, 2e-8)).norm(), 1e-12);
}

// A rigid disc held in place while the medium is pushed by the force F: uniform
// tractions, and on the disc the displacement of the force's field,
// ((3 - 4 nu) ln(r_0 / a) + 1/2) F / (8 pi mu (1 - nu)), plus the constant.
TEST_P(StaticSolver, pushed_rigid_disc)
{
  const double radius = 1.5, nu = medium.poisson();
  const Boundary boundary = test::cavity(radius, 48);
  StaticConditions conditions
      = all_displacements(Eigen::VectorXd::Zero(boundary.n_unknowns()));
  conditions.net_force = dealii::Point<2>(1., 0.);
  const auto solution  = solve_static(boundary, medium, GetParam(), conditions);
  const double pi      = 3.14159265358979324;
  for (unsigned e = 0; e < 48; ++e)
  {
    EXPECT_NEAR(solution.traction(2 * e), 1. / (2. * pi * radius), 1e-3);
    EXPECT_NEAR(solution.traction(2 * e + 1), 0., 1e-3);
  }
  const double expected = -(-(3. - 4. * nu) * std::log(radius) + 0.5)
                          / (8. * pi * medium.mu() * (1. - nu));
  EXPECT_NEAR(solution.constant[0], expected, 0.01 * std::abs(expected));
}

TEST_P(StaticSolver, square_in_tension)
{
  double error[3][2];
  for (const unsigned level : { 0u, 1u })
  {
    const Boundary boundary = square(level == 0 ? 0.25 : 0.125);
    const Eigen::VectorXd p = tension_traction(boundary);
    Eigen::VectorXd u       = tension_displacement(boundary);
    const unsigned n        = unsigned(u.size());

    // Sides x = 0 and y = 0 on rollers.
    StaticConditions rollers = all_tractions(p);
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
      for (const unsigned i : { 0u, 1u })
        if (boundary.elements[e].middle()(i) < 1e-9)
        {
          rollers.values(2 * e + i)             = 0.;
          rollers.displacement_known[2 * e + i] = true;
        }
    auto solution   = solve_static(boundary, medium, GetParam(), rollers);
    error[0][level] = relative(solution.displacement, u);

    solution = solve_static(boundary, medium, GetParam(), all_displacements(u));
    error[1][level] = relative(solution.traction, p);

    // Free: the mean motion is zero.
    solution = solve_static(boundary, medium, GetParam(), all_tractions(p));
    for (unsigned k = 0; k < n; ++k)
      u(k) -= tension_displacement(dealii::Point<2>(1., 1.))[k % 2];
    error[2][level] = relative(solution.displacement, u);
  }
  // Order one for displacements; tractions jump at the corners.
  EXPECT_LT(error[0][0], 0.013);
  EXPECT_LT(error[0][1], 0.52 * error[0][0]);
  EXPECT_LT(error[1][0], 0.045);
  EXPECT_LT(error[1][1], 0.72 * error[1][0]);
  EXPECT_LT(error[2][0], 0.013);
  EXPECT_LT(error[2][1], 0.52 * error[2][0]);
}

// For the radius exp(1 / (2 (3 - 4 nu))) m a uniform traction moves nothing
// by the integral over G.
TEST_P(StaticSolver, degenerate_scale)
{
  const double radius = std::exp(0.5 / (3. - 4. * medium.poisson()));
  double error[2];
  for (const unsigned k : { 0u, 1u })
  {
    const Boundary boundary
        = Boundary::circle({ 0., 0. }, k == 0 ? radius : 10., 32, false);
    const auto solution
        = solve_static(boundary, medium, GetParam(),
                       all_displacements(tension_displacement(boundary)));
    error[k] = relative(solution.traction, tension_traction(boundary));
  }
  EXPECT_NEAR(error[0], error[1], 1e-10);
  EXPECT_LT(error[0], 0.1);
}

TEST(SolveStatic, refuses)
{
  const Boundary boundary = square(0.5);
  const unsigned n        = unsigned(boundary.n_unknowns());
  EXPECT_THROW(solve_static(boundary, medium, Projection::galerkin,
                            all_tractions(Eigen::VectorXd::Ones(n))),
               InputError);
  Boundary open = boundary;
  open.elements.pop_back();
  EXPECT_THROW(solve_static(open, medium, Projection::galerkin,
                            all_tractions(tension_traction(open))),
               InputError);
  EXPECT_THROW(solve_static(boundary, medium, Projection::galerkin,
                            all_tractions(Eigen::VectorXd::Zero(3))),
               InputError);
}
