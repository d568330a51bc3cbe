// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "boundary_square.h"

#include <quoin/loads/load_field.h>
#include <quoin/motions/prescribed_motion.h>

#include <gtest/gtest.h>

using namespace quoin;
using quoin::test::BoundarySquare;

namespace
{
  /** The right side, driven to the right at 3 + 1000 t m/s. */
  LoadParameters to_the_right(const LoadQuantity quantity,
                              const std::string &text)
  {
    LoadParameters parameters;
    parameters.name          = "drive";
    parameters.boundaries    = { "right" };
    parameters.components[0] = BoundarySquare::component(quantity, text);
    return parameters;
  }
} // namespace

// v(dt/2) = 3.5 m/s, one node from 1 m/s, the other from 2 m/s:
// R = m (v1 - v0)/dt - f, its moment with the arms of t = 0.
TEST(PrescribedMotion, ReactionIsWhatTheMassesNeed)
{
  BoundarySquare square;
  PrescribedMotion<2> motion(
      to_the_right(LoadQuantity::velocity, "3 + 1000 * t"), square.nodes);
  ASSERT_EQ(motion.nodes(), (std::vector<unsigned int>{ 1, 2 }));
  square.state.velocity[1]   = dealii::Point<2>(1., 7.);
  square.state.velocity[2]   = dealii::Point<2>(2., 8.);
  square.state.nodes[2].u[1] = 0.5; // at a height of 3.5 m
  square.capture(motion,
                 { dealii::Point<2>(0., 0.), dealii::Point<2>(10., 50.),
                   dealii::Point<2>(-20., 60.), dealii::Point<2>(0., 0.) });
  square.move(motion);

  const double first  = 1. * 2.5 / square.dt - 10.;
  const double second = 2. * 1.5 / square.dt + 20.;
  EXPECT_NEAR(motion.resultant()[0], first + second, 1e-9);
  EXPECT_EQ(motion.resultant()[1], 0.);
  EXPECT_NEAR(motion.resultant()[2], -2. * first - 3.5 * second, 1e-9);
  EXPECT_DOUBLE_EQ(square.state.velocity[1][0], 3.5);
  EXPECT_EQ(square.state.velocity[1][1], 7.); // is left alone
  EXPECT_DOUBLE_EQ(square.state.nodes[2].u[0], 3.5 * square.dt);
  EXPECT_EQ(square.state.nodes[2].u[1], 0.5);

  // half a step before with the old velocity, half a step after with the new
  const double half = 0.5 * square.dt;
  EXPECT_NEAR(square.state.energy.external, half * (first * 1. + second * 2.),
              1e-9);
  EXPECT_NEAR(square.state.pending.external, half * (first + second) * 3.5,
              1e-9);
}

TEST(PrescribedMotion, ADisplacementMovesByItsChange)
{
  BoundarySquare square;
  PrescribedMotion<2> motion(
      to_the_right(LoadQuantity::displacement, "5 + 2 * t"), square.nodes);
  square.capture(motion,
                 std::vector<dealii::Tensor<1, 2>>(4, dealii::Tensor<1, 2>()));
  square.move(motion);
  EXPECT_NEAR(square.state.velocity[1][0], 2., 1e-9);
  EXPECT_NEAR(square.state.nodes[1].u[0], 2. * square.dt, 1e-12);
}

// By the place in the mesh: at heights of 2 m and 3 m, whatever has moved.
TEST(PrescribedMotion, AVelocityByPlace)
{
  BoundarySquare square;
  LoadParameters parameters      = to_the_right(LoadQuantity::velocity, "0");
  parameters.components[0].field = std::make_shared<LoadField>(
      SpaceTimeFunction("y * (10 + 1000 * t)", "./", 3, true));
  PrescribedMotion<2> motion(parameters, square.nodes);
  square.state.nodes[2].u[1] = 0.5;
  square.capture(motion,
                 std::vector<dealii::Tensor<1, 2>>(4, dealii::Tensor<1, 2>()));
  square.move(motion);
  EXPECT_DOUBLE_EQ(square.state.velocity[1][0], 21.);
  EXPECT_DOUBLE_EQ(square.state.velocity[2][0], 31.5);
  const LoadComponent &part = (*motion.parts())[0];
  EXPECT_NE(part.value({ 0., 0. }), part.value({ 1., 1. }));
}

// Where another load moves a component later, the work is that load's.
TEST(PrescribedMotion, BooksNoWorkOfComponentsThatAnotherLoadMoves)
{
  BoundarySquare square;
  PrescribedMotion<2> motion(to_the_right(LoadQuantity::velocity, "1"),
                             square.nodes);
  square.capture(motion, std::vector<dealii::Tensor<1, 2>>(
                             4, dealii::Tensor<1, 2>({ 9., 0. })));
  square.captured[0].owner[0] = nullptr;
  square.move(motion);
  EXPECT_NEAR(motion.resultant()[0], 2. / square.dt - 9., 1e-9);
}
