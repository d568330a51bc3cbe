// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"

#include <quoin/stages/stage_parameters.h>

using namespace quoin;

namespace
{
  /** A stage called "shear" of which the parameter file says @p text. */
  StageParameters read(const std::string &text)
  {
    return read_named_section<StageParameters>("shear", text);
  }

  void expect_refused(const std::string &text, const std::string &setting,
                      const std::string &why)
  {
    expect_section_refused("shear", setting + "' ", why, [&] { read(text); });
  }
} // namespace

TEST(StageParameters, Defaults)
{
  const auto stage = read("set Duration = 0.1\n");
  EXPECT_EQ(stage.name, "shear");
  EXPECT_TRUE(stage.loads.empty());
  EXPECT_EQ(stage.end, StageEnd::time);
  EXPECT_EQ(stage.duration, 0.1);
  EXPECT_LT(stage.start_time, 0.);
  EXPECT_EQ(stage.damping, DampingType::none);
  EXPECT_EQ(stage.local_coefficient, 0.);
  EXPECT_EQ(stage.mass_coefficient, 0.);
  EXPECT_EQ(stage.stiffness_coefficient, 0.);
  EXPECT_EQ(stage.scaled_time_step, 0.);
  EXPECT_EQ(stage.maximum_steps, 10000000U);
}

TEST(StageParameters, LoadsThatSlowDown)
{
  EXPECT_FALSE(read("set Duration = 0.1\n").slows_loads());
  const auto stage
      = read("set Duration = 0.1\nset Kinetic energy limit = 1e-3\n");
  EXPECT_TRUE(stage.slows_loads());
  EXPECT_EQ(stage.kinetic_limit, 1e-3);
  expect_refused("set End = static ratio\nset Kinetic energy limit = 1e-3\n",
                 "Kinetic energy limit = 1e-3", "End = time");
  expect_refused("set Duration = 1\nset Kinetic energy limit = 2\n",
                 "Kinetic energy limit = 2", "between 0 and 1");
}

TEST(StageParameters, StaticStage)
{
  const auto stage = read("set Loads = base, beam\nset End = static ratio\n"
                          "set Static ratio = 1e-5\nset Damping = local\n"
                          "set Local damping coefficient = 0.7\n"
                          "set Maximum steps = 500\nset Start time = 0.25\n"
                          "set Mass scaling = yes\n"
                          "set Scaled time step = 1e-4\n");
  EXPECT_EQ(stage.loads, (std::vector<std::string>{ "base", "beam" }));
  EXPECT_EQ(stage.end, StageEnd::static_ratio);
  EXPECT_EQ(stage.static_ratio, 1e-5);
  EXPECT_EQ(stage.damping, DampingType::local);
  EXPECT_EQ(stage.local_coefficient, 0.7);
  EXPECT_EQ(stage.maximum_steps, 500U);
  EXPECT_EQ(stage.start_time, 0.25);
  EXPECT_EQ(stage.scaled_time_step, 1e-4);
}

TEST(StageParameters, DampingThatSuitsTheEnd)
{
  EXPECT_EQ(read("set Duration = 1\n").damping, DampingType::none);
  const auto at_rest = read("set End = static ratio\n");
  EXPECT_EQ(at_rest.damping, DampingType::local);
  EXPECT_EQ(at_rest.local_coefficient, default_local_damping);
  const auto slow = read("set Duration = 1\nset Kinetic energy limit = 1e-4\n");
  EXPECT_EQ(slow.damping, DampingType::adaptive);
  EXPECT_EQ(slow.local_coefficient, 0.);
  EXPECT_EQ(read("set End = factor of safety\n").damping,
            DampingType::adaptive);
  const std::string pattern = "set Duration = 1\nset Load pattern = push\n"
                              "set Control function = 1e-3 * t^2\n";
  const auto pushed         = read(pattern);
  EXPECT_EQ(pushed.damping, DampingType::local);
  EXPECT_EQ(pushed.local_coefficient, default_local_damping);
  EXPECT_EQ(read(pattern + "set Kinetic energy limit = 1e-4\n").damping,
            DampingType::adaptive);
  // What is given holds, also none.
  EXPECT_EQ(read(pattern + "set Damping = none\n").damping, DampingType::none);
  EXPECT_EQ(read("set End = static ratio\nset Damping = none\n").damping,
            DampingType::none);
}

TEST(StageParameters, ConditionsThatEndIt)
{
  EXPECT_TRUE(read("set Duration = 1\n").end_conditions.empty());
  EXPECT_TRUE(read("set Duration = 1\n").duration_is_known());
  const auto stage
      = read("set Duration = 1\nset End conditions = all fallen: u > 1; "
             "v < 2 ? w > 1 : w > 2; at-rest : max(a, b) > 3\n");
  EXPECT_FALSE(stage.duration_is_known());
  ASSERT_EQ(stage.end_conditions.size(), 3U);
  EXPECT_EQ(stage.end_conditions[0].outcome, "all fallen");
  EXPECT_EQ(stage.end_conditions[0].expression, "u > 1");
  EXPECT_EQ(stage.end_conditions[1].outcome, "condition met");
  EXPECT_EQ(stage.end_conditions[1].expression, "v < 2 ? w > 1 : w > 2");
  EXPECT_EQ(stage.end_conditions[2].outcome, "at-rest");
  EXPECT_EQ(stage.end_conditions[2].expression, "max(a, b) > 3");
  expect_refused("set Duration = 1\nset End conditions = u > 1;; v > 1\n",
                 "End conditions = u > 1;; v > 1", "empty condition");
}

TEST(StageParameters, OutcomeOfAnyLength)
{
  const std::string outcome(1000000, 'x');
  const auto stage
      = read("set Duration = 1\nset End conditions = " + outcome + ": u > 1\n");
  ASSERT_EQ(stage.end_conditions.size(), 1U);
  EXPECT_EQ(stage.end_conditions[0].outcome, outcome);
}

TEST(StageParameters, OnlyTheChosenDampingActs)
{
  const std::string coefficients
      = "set Duration = 1\nset Local damping coefficient = 0.7\n"
        "set Rayleigh mass coefficient = 3\n"
        "set Rayleigh stiffness coefficient = 1e-5\nset Damping = ";
  const auto rayleigh = read(coefficients + "Rayleigh\n");
  EXPECT_EQ(rayleigh.damping, DampingType::rayleigh);
  EXPECT_EQ(rayleigh.local_coefficient, 0.);
  EXPECT_EQ(rayleigh.mass_coefficient, 3.);
  EXPECT_EQ(rayleigh.stiffness_coefficient, 1e-5);
  const auto adaptive = read(coefficients + "adaptive\n");
  EXPECT_EQ(adaptive.damping, DampingType::adaptive);
  EXPECT_EQ(adaptive.local_coefficient, 0.);
  EXPECT_EQ(adaptive.mass_coefficient, 0.);
  EXPECT_EQ(adaptive.stiffness_coefficient, 0.);
  // The scaled step is of no account without mass scaling.
  EXPECT_EQ(
      read("set Duration = 1\nset Scaled time step = 1\n").scaled_time_step,
      0.);
}

TEST(StageParameters, RefusesWhatMakesNoSense)
{
  expect_refused("", "Duration = 0", "positive");
  expect_refused("set Duration = -2\n", "Duration = -2", "positive");
  expect_refused("set End = static ratio\nset Static ratio = 0\n",
                 "Static ratio = 0", "positive");
  expect_refused("set Duration = 1\nset Start time = soon\n",
                 "Start time = soon", "number");
  expect_refused("set Duration = 1\nset Start time = -1\n", "Start time = -1",
                 "previous end");
  expect_refused("set Duration = 1\nset Damping = local\n"
                 "set Local damping coefficient = 1\n",
                 "Local damping coefficient = 1", "between");
  expect_refused("set Duration = 1\nset Damping = Rayleigh\n"
                 "set Rayleigh mass coefficient = -1\n",
                 "Rayleigh mass coefficient = -1", "negative");
  expect_refused("set Duration = 1\nset Damping = Rayleigh\n"
                 "set Rayleigh stiffness coefficient = -1\n",
                 "Rayleigh stiffness coefficient = -1", "negative");
  expect_refused("set Duration = 1\nset Mass scaling = yes\n",
                 "Scaled time step = 0", "positive");
}
