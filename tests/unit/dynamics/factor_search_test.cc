// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/factor_search.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  /** Searches in a model that is stable below @p limit. */
  FactorSearch searched(const SafetyParameters &parameters, const double limit)
  {
    FactorSearch search;
    while (!search.has_ended(parameters) && search.trials().size() < 1000)
    {
      SafetyTrial trial;
      trial.factor    = search.next(parameters);
      trial.is_stable = trial.factor < limit;
      search.add(trial);
    }
    return search;
  }
} // namespace

TEST(FactorSearch, BracketsTheLimit)
{
  for (const double limit : { 0.11, 0.5, 0.99, 1.01, 3., 9.9 })
  {
    const FactorSearch search = searched({}, limit);
    EXPECT_LT(search.highest_stable(), limit);
    EXPECT_GE(search.lowest_failing(), limit);
    EXPECT_LE(search.lowest_failing() - search.highest_stable(), 0.01);
    EXPECT_LT(search.trials().size(), 25U);
  }
}

TEST(FactorSearch, EndsAtTheLowestAndHighestFactors)
{
  EXPECT_EQ(searched({}, 0.05).lowest_failing(), 0.1);
  EXPECT_EQ(searched({}, 0.05).highest_stable(), 0.);
  EXPECT_EQ(searched({}, 11.).highest_stable(), 10.);
}

TEST(FactorSearch, NoStableFactorIsNoneOfTheBracket)
{
  SafetyParameters parameters;
  parameters.tolerance      = 1.;
  const FactorSearch search = searched(parameters, 0.5);
  EXPECT_GT(search.highest_stable(), 0.);
  EXPECT_GE(search.trials().size(), 4U);
}

TEST(FailureWatch, WhatSlowsDownHasNotFailed)
{
  // 5 (1 - exp(-i/3)) is above the limit when i > 11, where it was 4.3 or more
  // at half the time, though 1.4 at first.
  FailureWatch settles(4.9);
  for (unsigned int i = 1; i <= 100; ++i)
    EXPECT_FALSE(settles.has_failed(5. * (1. - std::exp(-1. / 3. * i))));
}

TEST(FailureWatch, WhatGoesOnMovingHasFailed)
{
  FailureWatch slides(1.), settles(1.);
  bool has_failed = false;
  for (unsigned int i = 1; i <= 100; ++i)
  {
    has_failed = has_failed || slides.has_failed(0.1 * i);
    EXPECT_FALSE(settles.has_failed(5. - 1. / i));
    EXPECT_FALSE(i <= 10 && has_failed) << "within the limit";
  }
  EXPECT_TRUE(has_failed);
}
