// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/time_control.h>

#include <gtest/gtest.h>

#include <vector>

using namespace quoin;

TEST(TimeControl, NegativeIsNeverAndZeroIsAlways)
{
  for (unsigned int i = 0; i < 10; ++i)
  {
    EXPECT_FALSE(TimeControl().is_due(0.1 * i, 0.1));
    EXPECT_FALSE(TimeControl(-2.).is_due(0.1 * i, 0.1));
    EXPECT_TRUE(TimeControl(0.).is_due(0.1 * i, 0.1));
  }
}

TEST(TimeControl, EveryStepIfTheIntervalIsNotLonger)
{
  for (unsigned int i = 0; i < 10; ++i)
  {
    EXPECT_TRUE(TimeControl(0.1).is_due(0.1 * i, 0.1));
    EXPECT_TRUE(TimeControl(0.03).is_due(0.1 * i, 0.1));
  }
}

TEST(TimeControl, OneStepForEachMultiple)
{
  // Whatever the ratio of interval and step: one step near each multiple,
  // never farther from it than half a step and the shift of ties.
  for (const double dt : { 1e-4, 0.7e-4, 0.333e-4, 2.9e-4 })
  {
    const double interval = 1e-3;
    const TimeControl control(interval);
    std::vector<unsigned int> due(101, 0);
    for (unsigned int i = 0; i * dt < 100.4 * interval; ++i)
      if (control.is_due(i * dt, dt))
      {
        const auto k = static_cast<unsigned int>(i * dt / interval + 0.5);
        EXPECT_LE(std::abs(i * dt - k * interval), 0.5004 * dt);
        ++due[k];
      }
    for (const unsigned int n : due)
      EXPECT_EQ(n, 1U);
  }
}

TEST(TimeControl, OneStepWhereMultiplesAreMidwayBetweenSteps)
{
  // From 0.5 s on there are n / 100 steps in each interval; odd multiples lie
  // midway where n is an odd multiple of 50.
  constexpr double interval = 0.02;
  const TimeControl control(interval);
  for (unsigned int n = 10050; n < 12000; n += 100)
  {
    const double dt = 2. / n;
    std::vector<unsigned int> due(100, 0);
    for (unsigned int i = n / 200; i < n - n / 200; ++i)
      if (control.is_due(0.5 + i * dt, dt))
        ++due[std::lround(i * dt / interval)];
    for (unsigned int k = 1; k < 99; ++k)
      EXPECT_EQ(due[k], 1U) << n << " steps, multiple " << k;
  }
}

TEST(TimeControl, KeepsNoMemory)
{
  const TimeControl control(1.);
  EXPECT_TRUE(control.is_due(3., 0.1));
  EXPECT_TRUE(control.is_due(3., 0.1));
  EXPECT_FALSE(control.is_due(2.6, 0.1));
  EXPECT_TRUE(control.is_due(0., 0.1));
}
