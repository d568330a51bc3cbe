// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loading/loading_rate.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

// Kinetic energy that goes with the square of the rate comes to half of its
// limit, from either side and without going beyond it.
TEST(LoadingRate, SteadyLoadingComesToHalfOfTheLimit)
{
  const double share_at_one = 40.; // kinetic energy by its limit
  for (double rate : { loading_rate::start, 1. })
  {
    for (unsigned int i = 0; i < 2000; ++i)
      rate = loading_rate::next(
          rate, loading_rate::growth(share_at_one * rate * rate, 1.));
    EXPECT_NEAR(share_at_one * rate * rate, 0.5, 1e-9);
  }
}

TEST(LoadingRate, FallsAtOnceAndRisesSlowly)
{
  EXPECT_DOUBLE_EQ(loading_rate::growth(0.5, 1.), 1.);
  EXPECT_DOUBLE_EQ(loading_rate::growth(1e9, 1.), 0.5);
  EXPECT_DOUBLE_EQ(loading_rate::growth(0., 1.), 1.1);
  EXPECT_DOUBLE_EQ(loading_rate::growth(1., 1.), std::sqrt(0.5));
}

// The same over many steps as over one.
TEST(LoadingRate, IsSpreadOverTheSteps)
{
  for (const double share : { 0., 0.4, 0.7, 100. })
    EXPECT_NEAR(std::pow(loading_rate::growth(share, 64.), 64.),
                loading_rate::growth(share, 1.), 1e-12);
}

TEST(LoadingRate, HasItsBounds)
{
  EXPECT_EQ(loading_rate::next(1., 1.1), 1.);
  EXPECT_EQ(loading_rate::next(loading_rate::slowest, 0.5),
            loading_rate::slowest);
}
