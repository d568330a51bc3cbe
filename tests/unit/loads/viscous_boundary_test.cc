// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/viscous_boundary.h>

#include <gtest/gtest.h>

using namespace quoin;

TEST(ViscousBoundary, ResultantHasItsMomentAboutTheOrigin)
{
  State state;
  state.nodes.resize(2);
  state.velocity.resize(2);
  state.nodes[0] = { { 1., 2. }, { 0., 0. } };
  state.nodes[1] = { { 4., 6. }, { 0.7, 0.9 } };
  StepContext step{};
  step.dt = step.dt_before = step.dt_velocity = 1e-3;
  std::array<double, 3> resultant{};
  for (const unsigned int i : { 0U, 1U })
  {
    // Displacements of the time before the step count; both are at rest.
    CapturedNode before{};
    before.node         = i;
    before.displacement = { { 0.5 * i, -0.5 * i } };
    account_for_dashpot(step, before, { { 2., 2., 0. } }, { { 3., 5. } },
                        nullptr, resultant, state);
  }
  EXPECT_DOUBLE_EQ(resultant[0], 6.);
  EXPECT_DOUBLE_EQ(resultant[1], 10.);
  EXPECT_DOUBLE_EQ(resultant[2], (1. * 5. - 2. * 3.) + (4.5 * 5. - 5.5 * 3.));
}
