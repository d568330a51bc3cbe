// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_problem/load_record.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

using namespace quoin;

TEST(LoadRecord, KeepsTheFactorOfTheLargestMagnitude)
{
  LoadRecord record;
  record.add_factor(0.3, 1e-3, 1.);
  record.add_factor(-0.5, 2e-3, 2.);
  record.add_factor(0.4, 3e-3, 3.);
  nlohmann::ordered_json stage;
  record.summarise(stage);
  EXPECT_EQ(stage["largest load factor"]["factor"], -0.5);
  EXPECT_EQ(stage["largest load factor"]["controlled displacement [m]"], 2e-3);
  EXPECT_EQ(stage["largest load factor"]["time [s]"], 2.);
}

TEST(LoadRecord, WarnsOfAMoreThanTwentiethThatSupportsDoNotTake)
{
  // A wall that bears 183 kN is pushed by up to the second force.
  for (const double most : { 190e3, 206e3 })
    for (const double sign : { 1., -1. })
    {
      LoadRecord record;
      for (unsigned int i = 0; i <= 100; ++i)
      {
        const double force = most * 0.01 * i;
        record.add_forces({ { sign * force, -5e5, 0. },
                            { -sign * std::min(force, 183e3), 4e5, 0. },
                            { force, 5e5, 0. } },
                          0.01 * i);
      }
      nlohmann::ordered_json stage;
      record.summarise(stage);
      EXPECT_EQ(record.warning().empty(), most < 200e3);
      EXPECT_EQ(stage.empty(), most < 200e3);
      if (most < 200e3)
        continue;
      const auto &x = stage["supports do not take the loads"]["x"];
      EXPECT_EQ(x["applied [N]"], sign * most);
      EXPECT_EQ(x["supports [N]"], -sign * 183e3);
      EXPECT_EQ(x["time [s]"], 1.);
      // The weight is constant: what rises to it is no loading.
      EXPECT_EQ(stage["supports do not take the loads"].size(), 1U);
    }
}

TEST(LoadRecord, VibrationAboutABalanceIsNoLackOfSupport)
{
  LoadRecord record;
  for (unsigned int i = 0; i <= 400; ++i)
  {
    const double t = 0.01 * i, force = std::min(1., t);
    record.add_forces({ { 0., -force, 0. },
                        { 0., force * (1. + 0.3 * std::sin(20. * t)), 0. },
                        { 0., force, 0. } },
                      t);
  }
  EXPECT_TRUE(record.warning().empty());
}

TEST(LoadRecord, VibrationHidesNoLackOfSupport)
{
  // Supports that take 93 % or 97 % of the load on average, and for moments
  // all of it; 5000 rows are more than are kept.
  for (const double share : { 0.93, 0.97 })
  {
    LoadRecord record;
    for (unsigned int i = 0; i < 5000; ++i)
    {
      const double t = 1e-3 * i, force = std::min(1., t);
      record.add_forces(
          { { force, 0., 0. },
            { -force * (share + 0.1 * std::sin(100. * t)), 0., 0. },
            { force, 0., 0. } },
          t);
    }
    EXPECT_EQ(record.warning().empty(), share > 0.95);
    nlohmann::ordered_json stage;
    record.summarise(stage);
    if (share > 0.95)
      continue;
    const auto &x = stage["supports do not take the loads"]["x"];
    EXPECT_NEAR(x["applied [N]"], 1., 1e-12);
    // A window of 0.5 s has eight periods, but for a part of one.
    EXPECT_NEAR(x["supports [N]"], -share, 0.1 * 2. / (100. * 0.5));
  }
}

TEST(LoadRecord, LoadsThatBalanceEachOtherNeedNoSupport)
{
  // Pressure on both sides of a hole, whose rounding nothing takes; a wall of
  // which only one is pressed.
  for (const double net : { 1e-3, 0.2 })
  {
    LoadRecord record;
    for (unsigned int i = 0; i <= 10; ++i)
    {
      const double force = 1e5 * i;
      record.add_forces(
          { { net * force, 0., 0. }, { 0., 0., 0. }, { force, 0., 0. } },
          0.1 * i);
    }
    EXPECT_EQ(record.warning().empty(), net < 0.01);
  }
}

// Loads whose work is 1 J for a factor of 1 go on at the factor 2.
TEST(LoadRecord, WarnsOfATwentiethOfTheWorkThatDampingTakes)
{
  for (const double share : { 0.04, 0.06 })
  {
    LoadRecord record;
    for (unsigned int i = 0; i <= 10; ++i)
    {
      record.add_factor(2., 0.1 * i, 0.1 * i);
      record.add_work(2., 7. + 0.1 * i, 3. + 2. * share * 0.1 * i, 0.);
    }
    EXPECT_EQ(record.warning().empty(), share < 0.05);
    nlohmann::ordered_json stage;
    record.summarise(stage);
    EXPECT_NEAR(stage["damping by work of the load pattern"], share, 1e-12);
  }
}

TEST(LoadRecord, WarnsOfAFactorThatIsAboveItsMeans)
{
  // A model bears 0.25; the factor has a spike of so many rows of 1500.
  for (const unsigned int spike : { 1U, 20U, 150U })
  {
    LoadRecord record;
    for (unsigned int i = 0; i <= 1500; ++i)
    {
      const double moved = 1e-6 * i, at_rest = std::min(0.25, 1e3 * moved);
      const double factor = at_rest + (i >= 700 && i < 700 + spike ? 0.05 : 0.);
      record.add_factor(factor, moved, 1e-3 * i);
      record.add_work(factor, 1e4 * moved, 0., 0.);
    }
    nlohmann::ordered_json stage;
    record.summarise(stage);
    const double mean
        = stage["largest load factor"]["mean over a twentieth of the stage"];
    EXPECT_NEAR(mean, spike == 150 ? 0.3 : 0.25, spike == 20 ? 0.02 : 1e-3);
    EXPECT_EQ(record.warning().empty(), spike == 150);
    if (spike == 150)
      continue;
    EXPECT_NE(record.warning().find("largest load factor, 0.3 at time 0.7"),
              std::string::npos);
  }
}

TEST(LoadRecord, FactorsThatSetTheModelInMotionAreNoResistance)
{
  // A mechanism that bears 1 speeds up with a factor of 1.14 for half of the
  // stage, longer than a mean, and goes on at its velocity, or loses it to
  // dashpots.
  for (const bool is_damped : { false, true })
  {
    LoadRecord record;
    for (unsigned int i = 0; i <= 1500; ++i)
    {
      const double moved  = 1e-3 * i;
      const double pushed = std::max(0., std::min(moved, 1.2) - 0.45);
      const double factor = moved < 0.45  ? moved / 0.45
                            : moved < 1.2 ? 1.14
                                          : 1.;
      const double energy = 0.14 * pushed;
      record.add_factor(factor, moved, moved);
      record.add_work(factor, moved, is_damped ? energy : 0.,
                      is_damped ? 0. : energy);
    }
    nlohmann::ordered_json stage;
    record.summarise(stage);
    const auto &largest = stage["largest load factor"];
    EXPECT_NEAR(largest["mean over a twentieth of the stage"], 1.14, 1e-3);
    EXPECT_NEAR(largest["mean without inertia and damping"], 1., 2e-3);
    EXPECT_NE(record.warning().find("14"), std::string::npos);
  }
}

namespace
{
  /** A platen that presses with 100 N and pulls with @p pulled [N] in
      @p n_pulling of 100 rows. */
  LoadRecord platen(const double pulled, const unsigned int n_pulling,
                    const double tension = 5e3)
  {
    LoadRecord record;
    for (unsigned int i = 0; i < 100; ++i)
    {
      PlatenBearing<2> bearing;
      bearing.pressed = 100.;
      if (i >= 100 - n_pulling)
      {
        bearing.pulled  = pulled * (i + 1) / 100.;
        bearing.tension = tension;
        bearing.place   = { 2., 0.5 };
      }
      record.add_bearing("plate", bearing, i);
    }
    return record;
  }
} // namespace

TEST(LoadRecord, WarnsOfPlatensThatPull)
{
  const LoadRecord record = platen(30., 10);
  const std::string text  = record.warning();
  for (const char *part :
       { "the platen plate pulled", "5000 Pa", "at (2, 0.5) m and time 99 s",
         "30 N in all", "100 N at the most", "'Group'" })
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  nlohmann::ordered_json stage;
  record.summarise(stage);
  EXPECT_EQ(stage["platens that pull"]["plate"]["pulled [N]"], 30.);
  EXPECT_TRUE(platen(4., 100).warning().empty()); // the corners of a block
  EXPECT_TRUE(platen(30., 4).warning().empty());  // a wave that passes
  EXPECT_TRUE(platen(90., 10).warning().empty()); // a clamp
  EXPECT_TRUE(platen(30., 10, 1.).warning().empty());
}
