// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../motions/boundary_square.h"

#include <quoin/absorbing/viscous_boundary.h>

#include <gtest/gtest.h>

using namespace quoin;
using quoin::test::BoundarySquare;

namespace
{
  /** Dashpots at the right side, 1 m by 0.5 m: rho c1 = 300, rho c2 = 200. */
  ViscousBoundary<2> at_the_right(const BoundarySquare &square,
                                  const std::string &normal,
                                  const std::string &shear)
  {
    LoadParameters parameters;
    parameters.name       = "far";
    parameters.boundaries = { "right" };
    parameters.components[0]
        = BoundarySquare::component(LoadQuantity::velocity, normal);
    parameters.components[1]
        = BoundarySquare::component(LoadQuantity::velocity, shear);
    return { parameters, square.nodes, { { 300., 200. } }, 0.5 };
  }
} // namespace

TEST(ViscousBoundary, ResultantHasItsMomentAboutTheOrigin)
{
  State<2> state;
  state.nodes.resize(2);
  state.velocity.resize(2);
  state.nodes[0] = { { 1., 2. }, {} };
  state.nodes[1] = { { 4., 6. }, dealii::Point<2>(0.7, 0.9) };
  StepContext step{};
  step.dt = step.dt_before = step.dt_velocity = 1e-3;
  std::array<double, 3> resultant{};
  for (const unsigned int i : { 0U, 1U })
  {
    // Displacements of the time before the step count; both are at rest.
    CapturedNode<2> before{};
    before.node         = i;
    before.displacement = dealii::Point<2>(0.5 * i, -0.5 * i);
    account_for_dashpot<2>(step, before, { { 2., 2., 0. } },
                           dealii::Point<2>(3., 5.), nullptr, resultant, state);
  }
  EXPECT_DOUBLE_EQ(resultant[0], 6.);
  EXPECT_DOUBLE_EQ(resultant[1], 10.);
  EXPECT_DOUBLE_EQ(resultant[2], (1. * 5. - 2. * 3.) + (4.5 * 5. - 5.5 * 3.));
}

// Beside rollers, before a face inclined to them: a free component feels the
// drag of the velocity that the others really have.
TEST(ViscousBoundary, WhatIsPrescribedDragsTheFreeComponents)
{
  const Dashpot<2>::Damping damping{ { 40., 50., -30. } };
  const double m = 2., h = 0.5e-2;
  StepContext step{};
  step.dt = step.dt_before = step.dt_velocity = 2. * h;
  for (const double prescribed : { 0., 0.7 })
  {
    State<2> state;
    state.nodes.resize(1);
    state.velocity.resize(1);
    state.velocity[0][0] = prescribed;
    state.nodes[0].u[0]  = 11.;
    CapturedNode<2> before{};
    before.mass         = m;
    before.velocity     = dealii::Point<2>(0.4, 0.9);
    before.force        = dealii::Point<2>(7., 5.);
    before.displacement = dealii::Point<2>(0.1, 0.2);
    const BoundarySquare square;
    const ViscousBoundary<2> boundary = at_the_right(square, "0", "0");
    before.owner[1]                   = &boundary;
    const dealii::Point<2> pull(3., 6.);
    move_with_dashpot<2>(step, before, damping, pull, &boundary, state);
    const double v1 = ((m - h * 50.) * 0.9 + 2. * h * (5. + 6.)
                       + h * 30. * (0.4 + prescribed))
                      / (m + h * 50.);
    EXPECT_DOUBLE_EQ(state.velocity[0][0], prescribed);
    EXPECT_DOUBLE_EQ(state.nodes[0].u[0], 11.);
    EXPECT_NEAR(state.velocity[0][1], v1, 1e-14);
    EXPECT_NEAR(state.nodes[0].u[1], 0.2 + 2. * h * v1, 1e-14);

    // What is booked is all that this component has gained.
    std::array<double, 3> resultant{};
    account_for_dashpot<2>(step, before, damping, pull, &boundary, resultant,
                           state);
    const double work = state.energy.external + state.pending.external
                        - state.energy.viscous - state.pending.viscous
                        + h * 5. * (0.9 + v1);
    EXPECT_NEAR(work, 0.5 * m * (v1 * v1 - 0.9 * 0.9), 1e-13);
  }
}

TEST(ViscousBoundary, PrescribedComponentsInSpaceAreNoUnknowns)
{
  const Dashpot<3>::Damping damping{ { 40., 50., 60., -30., 20., 10. } };
  const dealii::Point<3> v0(0.4, 0.9, -0.2), force(7., 5., 3.);
  const double m = 2., h = 0.5e-2;
  StepContext step{};
  step.dt_velocity  = 2. * h;
  step.mass_damping = 3.;
  for (unsigned int mask = 0; mask < 8; ++mask)
  {
    std::array<bool, 3> prescribed;
    for (unsigned int d = 0; d < 3; ++d)
      prescribed[d] = mask >> d & 1U;
    const dealii::Point<3> given(0.3, -0.1, 0.6);
    const auto v1 = velocity_with_dashpot<3>(step, m, v0, damping, force,
                                             prescribed, given);
    const auto &[xx, yy, zz, xy, xz, yz] = damping;
    const double rows[3][3]
        = { { xx, xy, xz }, { xy, yy, yz }, { xz, yz, zz } };
    for (unsigned int d = 0; d < 3; ++d)
    {
      if (prescribed[d])
      {
        EXPECT_DOUBLE_EQ(v1[d], given[d]);
        continue;
      }
      double balance = 2. * h * force[d] - m * (v1[d] - v0[d])
                       - h * step.mass_damping * m * (v0[d] + v1[d]);
      for (unsigned int e = 0; e < 3; ++e)
        balance -= h * rows[d][e] * (v0[e] + v1[e]);
      EXPECT_NEAR(balance, 0., 1e-14);
    }
  }
}

// Heavy nodes that hardly move: -rho c v per area.
TEST(ViscousBoundary, ResistsMotionByItsImpedance)
{
  BoundarySquare square;
  square.mass                 = { 1e9, 1e9, 1e9, 1e9 };
  ViscousBoundary<2> boundary = at_the_right(square, "0", "0");
  boundary.prepare(square.state);
  boundary.begin_stage(square.state, false);
  for (dealii::Tensor<1, 2> &v : square.state.velocity)
    v = dealii::Point<2>(2., 3.);
  square.capture(boundary,
                 std::vector<dealii::Tensor<1, 2>>(4, dealii::Tensor<1, 2>()));
  square.move(boundary);
  const double area = 0.5;
  EXPECT_NEAR(boundary.resultant()[0], -300. * 2. * area, 1e-6);
  EXPECT_NEAR(boundary.resultant()[1], -200. * 3. * area, 1e-6);
  // about the origin, with the middle of the side at (4, 2.5)
  EXPECT_NEAR(boundary.resultant()[2],
              4. * -200. * 3. * area - 2.5 * -300. * 2. * area, 1e-6);
  EXPECT_NEAR(square.state.energy.viscous,
              0.5 * square.dt * area * (300. * 4. + 200. * 9.), 1e-9);
}

// A wave that comes in pushes with twice its traction. Its normal velocity
// counts into the model, to the left here, the other along the tangent, up.
TEST(ViscousBoundary, IncidentWavesPushWithTwiceTheirTraction)
{
  BoundarySquare square;
  square.mass                 = { 1e9, 1e9, 1e9, 1e9 };
  ViscousBoundary<2> boundary = at_the_right(square, "2", "3");
  boundary.prepare(square.state);
  boundary.begin_stage(square.state, false);
  square.capture(boundary,
                 std::vector<dealii::Tensor<1, 2>>(4, dealii::Tensor<1, 2>()));
  square.move(boundary);
  EXPECT_NEAR(boundary.resultant()[0], -2. * 300. * 2. * 0.5, 1e-6);
  EXPECT_NEAR(boundary.resultant()[1], 2. * 200. * 3. * 0.5, 1e-6);
}
