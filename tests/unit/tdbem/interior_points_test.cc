// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "cavity.h"

#include <quoin/base/packed_vectors.h>
#include <quoin/tdbem/time_marching.h>
#include <quoin/tdbem/direct_history.h>
#include <quoin/tdbem/interior_points.h>
#include <quoin/tdbem/influence_matrices.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{

  /** nu = 1/4, c_1 = 1, 2 mu = 1. */
  const ElasticMedium medium{ 1.5, 1., 1. / std::sqrt(3.) };

  /** What happens on a boundary under tractions that are switched on. */
  BoundaryRecord step_load(const Boundary &boundary, const double time_step,
                           const unsigned n_steps, const Eigen::VectorXd &p,
                           const double decay = 0.)
  {
    InfluenceMatrices::Options options;
    options.decay = decay;
    const InfluenceMatrices kernel(boundary, medium, time_step, options);
    DirectHistory history(kernel);
    TimeMarching marching(kernel, history,
                          std::vector<bool>(boundary.n_unknowns(), true));
    BoundaryRecord record{ time_step, decay, {}, {} };
    record.displacement.resize(n_steps, boundary.n_unknowns());
    record.traction.resize(n_steps, boundary.n_unknowns());
    for (unsigned step = 0; step < n_steps; ++step)
    {
      marching.step(p);
      record.displacement.row(step) = marching.u();
      record.traction.row(step)     = marching.p();
    }
    return record;
  }

  Eigen::MatrixXd displacements(const Boundary &boundary,
                                const BoundaryRecord &record,
                                const std::vector<dealii::Point<2>> &points,
                                const std::vector<unsigned> &steps)
  {
    return interior_displacements(boundary, medium, record, points, steps,
                                  MPI_COMM_WORLD);
  }
} // namespace

TEST(InteriorPoints, CavityUnderStepPressure)
{
  const Boundary boundary = test::cavity(1., 64);
  const auto record
      = step_load(boundary, 0.1, 90, test::unit_pressure(boundary));
  const dealii::Point<2> direction(std::cos(0.7), std::sin(0.7));
  const std::vector<unsigned> steps = { 0, 5, 9, 15, 20, 30, 50, 90 };
  // Inverse transform of K_1(2 s) / (K_1(s) + kappa s K_0(s)) / s.
  const double exact[]
      = { 0., 0., 0., .213685, .381375, .587882, .661355, .526290 };
  const auto u = displacements(
      boundary, record, { 2. * direction, dealii::Point<2>(0.3, -0.2) }, steps);
  for (unsigned l = 0; l < steps.size(); ++l)
  {
    const auto value = vector_at(u.col(l), 0);
    EXPECT_NEAR(value * direction, exact[l], 0.66e-3) << steps[l];
    EXPECT_NEAR(value[0] * direction[1] - value[1] * direction[0], 0., 0.66e-3);
    // Outside of the domain.
    EXPECT_LT((u.block<2, 1>(2, l).norm()), 0.02) << steps[l];
  }
  for (unsigned l = 0; l < 3; ++l)
    EXPECT_EQ(u.block(0, l, 2, 1).norm(), 0.) << "before the arrival";
}

TEST(InteriorPoints, UniformMotionOfASquare)
{
  // Tractions on one side only, long after: the square moves freely, and the
  // point in the middle as the mean of its boundary does.
  const Boundary boundary = Boundary::polygon(
      { { 0., 0. }, { 1., 0. }, { 1., 1. }, { 0., 1. } }, 0.125, false);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(boundary.n_unknowns());
  for (unsigned e = 0; e < boundary.n_elements(); ++e)
    if (boundary.elements[e].normal()[0] > 0.5)
      p[2 * e] = 1.;
  const unsigned n  = 160;
  const auto record = step_load(boundary, 0.125, n, p);
  const auto u
      = displacements(boundary, record, { dealii::Point<2>(0.5, 0.5) }, { n });
  const double t     = 0.125 * n;
  const double whole = 0.5 * t * t / medium.density;
  EXPECT_NEAR(u(0, 0) / whole, 1., 0.01);
  EXPECT_NEAR(u(1, 0) / whole, 0., 1e-3);
}

TEST(InteriorPoints, StepsAreThoseOfOneSweep)
{
  const Boundary boundary = test::cavity(1., 16);
  const auto record
      = step_load(boundary, 0.4, 40, test::unit_pressure(boundary), 0.05);
  const std::vector<dealii::Point<2>> points
      = { { 1.5, 0.2 }, { -2., 3. }, { 0., 9. } };
  std::vector<unsigned> steps(41);
  for (unsigned step = 0; step <= 40; ++step)
    steps[step] = step;
  const auto all = displacements(boundary, record, points, steps);
  for (const unsigned step : { 1u, 7u, 40u })
  {
    const auto one = displacements(boundary, record, points, { step });
    EXPECT_LT((one - all.col(step)).norm(), 1e-13 * all.norm()) << step;
  }
  EXPECT_GT(all.col(40).norm(), 0.1);
}

TEST(InteriorPoints, StaticCavity)
{
  const Boundary boundary = test::cavity(1., 64);
  StaticConditions conditions;
  conditions.values = test::unit_pressure(boundary);
  conditions.displacement_known.assign(boundary.n_unknowns(), false);
  const auto solution
      = solve_static(boundary, medium, Projection::galerkin, conditions);
  const dealii::Point<2> direction(std::cos(0.3), std::sin(0.3));
  const auto u = static_interior_displacements(
      boundary, medium, solution, { 1.5 * direction, 4. * direction });
  // 2 mu u / (p a) = a / r
  EXPECT_NEAR(vector_at(u, 0) * direction, 1. / 1.5, 1e-3);
  EXPECT_NEAR(vector_at(u, 1) * direction, 0.25, 1e-3);
}

TEST(InteriorPoints, StaticUniformStrain)
{
  // u = (x, -y): tractions 2 mu (n_x, -n_y), displacements partly given.
  const Boundary boundary = Boundary::polygon(
      { { 0., 0. }, { 2., 0. }, { 2., 1. }, { 0., 1. } }, 0.05, false);
  StaticConditions conditions;
  conditions.values.resize(boundary.n_unknowns());
  for (unsigned e = 0; e < boundary.n_elements(); ++e)
  {
    const auto &element = boundary.elements[e];
    const bool fixed    = element.normal()[0] < -0.5;
    for (unsigned i = 0; i < 2; ++i)
    {
      conditions.displacement_known.push_back(fixed);
      const dealii::Tensor<1, 2> of
          = fixed ? element.middle() : element.normal();
      conditions.values[2 * e + i] = (i == 0 ? 1. : -1.) * of[i];
    }
  }
  const auto solution
      = solve_static(boundary, medium, Projection::galerkin, conditions);
  const auto u = static_interior_displacements(boundary, medium, solution,
                                               { dealii::Point<2>(1.2, 0.4) });
  EXPECT_NEAR(u[0], 1.2, 5e-3);
  EXPECT_NEAR(u[1], -0.4, 5e-3);
}
