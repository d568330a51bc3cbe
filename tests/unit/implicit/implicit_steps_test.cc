// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_steps.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  /** Begins a jump of a stage of 2 s after a load step of 0.1 of it, at the
      load time 1 s and with @p released [-] of what was held. */
  StepTarget jump(const bool loads_rest, const bool safety,
                  const double released, State<2> &state,
                  const ImplicitParameters &parameters = {})
  {
    ImplicitSteps steps(parameters);
    steps.begin_stage(2., loads_rest, safety);
    ImplicitState &now = state.add<ImplicitState>();
    now.released       = released;
    now.step           = 0.1;
    EXPECT_TRUE(steps.begin_jump(1., now));
    EXPECT_TRUE(now.jumps);
    return steps.target(now, 1.);
  }
} // namespace

TEST(ImplicitSteps, AJumpGoesAsFarAsTheStepThatFailed)
{
  State<2> state;
  const StepTarget target = jump(false, false, 1., state);
  EXPECT_DOUBLE_EQ(target.load_time, 1.2);
  EXPECT_EQ(target.released, 1.);
}

// Under constant loads nothing is left to do once it has ended.
TEST(ImplicitSteps, AJumpUnderConstantLoadsGoesToTheEndOfTheStage)
{
  for (const bool safety : { false, true })
  {
    State<2> state;
    EXPECT_EQ(jump(true, safety, 1., state).load_time, 2.);
  }
}

TEST(ImplicitSteps, AJumpReleasesWhatTheStepThatFailedWould)
{
  State<2> state;
  const StepTarget target = jump(true, false, 0.5, state);
  EXPECT_EQ(target.load_time, 1.);
  EXPECT_DOUBLE_EQ(target.released, 0.6);
  // The release goes on by as much, unless it is over.
  ImplicitState &now       = state.get<ImplicitState>();
  const ImplicitState from = now;
  now.released             = 0.6;
  ImplicitSteps steps{ ImplicitParameters() };
  steps.begin_stage(2., false, false);
  steps.end_jump(from, now);
  EXPECT_FALSE(now.jumps);
  EXPECT_DOUBLE_EQ(now.step, 0.1);
  now.released = 1.;
  steps.end_jump(from, now);
  EXPECT_EQ(now.step, ImplicitParameters().first_step);
  // A search for the factor of safety releases all at once.
  State<2> trial;
  EXPECT_EQ(jump(true, true, 0.5, trial).released, 1.);
}

// Cracks that open far do so in steps that grow.
TEST(ImplicitSteps, StepsOfALongJumpGrowWithItsPath)
{
  ImplicitParameters parameters;
  parameters.largest_path_step = 1e-6;
  ImplicitSteps steps(parameters);
  steps.begin_stage(2., false, false);
  ImplicitState now;
  EXPECT_DOUBLE_EQ(steps.most_jump_path(now), 1e-6);
  now.drag_path = 1e-3;
  EXPECT_DOUBLE_EQ(steps.most_jump_path(now), 2e-5);
}

// A mechanism that goes on by jumps.
TEST(ImplicitSteps, LoadStepsGrowFromJumpToJump)
{
  ImplicitSteps steps{ ImplicitParameters() };
  steps.begin_stage(1., false, false);
  for (const bool after_jump : { false, true })
  {
    ImplicitState before, now;
    before.after_jump = after_jump;
    now.last_step     = 0.01;
    now.jumps         = true;
    now.n_drag        = 50;
    steps.end_jump(before, now);
    EXPECT_TRUE(now.after_jump);
    EXPECT_DOUBLE_EQ(now.step, after_jump ? 0.015 : 0.003);
  }
}
