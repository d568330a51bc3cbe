// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/phase_clock.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  void wait(const double seconds)
  {
    const auto start = WallClock::now();
    while (seconds_since(start) < seconds)
      ;
  }
} // namespace

// One step in 17 or so is measured and counts for all, also where a task comes
// in every 17th; a task that is measured by itself is not part of the lap
// around it.
TEST(PhaseClock, FindsTheTimeOfEachPhase)
{
  PhaseClock clock;
  const unsigned int blocks = clock.phase("blocks"),
                     joints = clock.phase("joints"),
                     output = clock.phase("output");
  EXPECT_EQ(clock.phase("joints"), joints);
  const unsigned int rare          = clock.phase("rare");
  const auto start                 = WallClock::now();
  constexpr unsigned int n_samples = 200,
                         n         = n_samples * PhaseClock::steps_per_sample;
  for (unsigned int i = 0; i < n; ++i)
  {
    clock.begin_step();
    wait(1e-5);
    clock.lap(blocks);
    if (i % 100 == 0)
      clock.measure(output, [] { wait(1e-3); });
    wait(2e-5);
    clock.lap(joints);
    if (i % PhaseClock::steps_per_sample == 3)
      wait(3e-4);
    clock.lap(rare);
  }
  const double all = seconds_since(start);
  // The number of samples varies by some per cent, that of those with the rare
  // task by a third; and the machine may hold the process up.
  EXPECT_GE(clock.time(blocks), 0.8 * n * 1e-5);
  EXPECT_GE(clock.time(joints), 0.8 * n * 2e-5);
  EXPECT_GE(clock.time(rare), 0.2 * n_samples * 3e-4);
  EXPECT_GE(clock.time(output), n / 100 * 1e-3 * (1. - 1e-9));
  EXPECT_LT(clock.time(output), all);
  EXPECT_EQ(clock.phases().size(), 4U);
}
