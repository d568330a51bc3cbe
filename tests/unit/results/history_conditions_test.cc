// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"

#include <quoin/base/exceptions.h>
#include <quoin/results/history_conditions.h>

#include <gtest/gtest.h>

#include <limits>

using namespace quoin;

namespace
{
  const std::vector<std::string> histories
      = { "force", "crown settlement", "2nd" };

  /** Number of the first condition met by the last of @p rows. */
  std::size_t met(const std::vector<std::string> &expressions,
                  const std::vector<std::vector<double>> &rows)
  {
    const HistoryConditions conditions(expressions, histories);
    std::vector<double> peaks;
    std::size_t result = 0;
    for (const auto &row : rows)
      result = conditions.find_met(row, peaks);
    return result;
  }

  void expect_refused(const std::string &expression, const std::string &why)
  {
    const std::string message = message_of<InputError>(
        [&] {
          HistoryConditions({ "force > 1", expression }, histories);
        });
    EXPECT_EQ(message.find("has the condition '" + expression + "', "), 0U)
        << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }
} // namespace

TEST(HistoryConditions, CompareColumnsAndTime)
{
  const std::vector<double> row = { 0.5, -3., 0.02, 7. };
  EXPECT_EQ(met({ "force < -3.5", "crown_settlement > 1e-2" }, { row }), 1U);
  EXPECT_EQ(met({ "abs(force) > 2.9", "crown_settlement > 1e-2" }, { row }),
            0U);
  EXPECT_EQ(met({ "_2nd == 7" }, { row }), 0U);
  EXPECT_EQ(met({ "time > 0.5" }, { row }), 1U);
  EXPECT_EQ(met({ "time >= 0.5 && max(force, _2nd) > 2*pi" }, { row }), 0U);
  EXPECT_EQ(met({ "time > 0.5 || force > 0" }, { row }), 1U);
  EXPECT_EQ(met({ "if(force < 0, time > 0.4, time > 9) > 0" }, { row }), 0U);
  EXPECT_EQ(met({ "force*1.e0 + .5 < -2.4E+0" }, { row }), 0U);
}

TEST(HistoryConditions, PeaksAreLargestMagnitudesSoFar)
{
  const std::vector<std::string> softened = { "abs(force) < 0.8*peak_force" };
  EXPECT_EQ(met(softened, { { 0., 0., 0., 0. } }), 1U);
  EXPECT_EQ(met(softened, { { 0., -5., 0., 0. }, { 1., -4.1, 0., 0. } }), 1U);
  EXPECT_EQ(met(softened, { { 0., -5., 0., 0. }, { 1., -3.9, 0., 0. } }), 0U);
  EXPECT_EQ(met({ "peak_crown_settlement > 2" },
                { { 0., 0., -3., 0. }, { 1., 0., 1., 0. } }),
            0U);
}

TEST(HistoryConditions, WhatIsNoNumberMeetsNothingAndIsNoPeak)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(met({ "force > 1", "force <= 1", "peak_force > 4" },
                { { 0., 5., 0., 0. }, { 1., nan, 0., 0. } }),
            2U);
}

TEST(HistoryConditions, LongWords)
{
  const std::string longest(100, 'x'), endless(200000, 'x');
  std::vector<double> peaks;
  EXPECT_EQ(HistoryConditions({ longest + " > 0.1" + std::string(1000, '1') },
                              { longest })
                .find_met({ 0., 0.2 }, peaks),
            0U);
  expect_refused(endless + " > 1", "is no history");
  const std::string message = message_of<InputError>(
      [&] { HistoryConditions({ endless + " > 1" }, { endless }); });
  EXPECT_NE(message.find("more than 100 letters"), std::string::npos);
}

TEST(HistoryConditions, RefusesWhatItCannotDecide)
{
  expect_refused("forces > 1", "The nearest one is 'force'.");
  expect_refused("crown settlement > 1", "'crown' is no history. Known are: ");
  expect_refused("force", "compares nothing");
  expect_refused("1 < 2", "names no history. Known are: time, force, "
                          "crown_settlement, _2nd, peak_force");
  expect_refused("force > (1", "no expression");
  expect_refused("force = 1", "no expression");
  expect_refused("reach(force) > 1", "no expression");
  const std::string message = message_of<InputError>(
      [] {
        HistoryConditions({ "a_b > 1" }, { "a b", "a.b" });
      });
  EXPECT_NE(message.find("'a_b' may mean two"), std::string::npos) << message;
}
