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

// One step in 17 is measured and counts for all; a task that is measured by
// itself is not part of the lap around it.
TEST(PhaseClock, FindsTheTimeOfEachPhase)
{
  PhaseClock clock;
  const unsigned int blocks = clock.phase("blocks"),
                     joints = clock.phase("joints"),
                     output = clock.phase("output");
  EXPECT_EQ(clock.phase("joints"), joints);
  const auto start         = WallClock::now();
  constexpr unsigned int n = 10 * PhaseClock::steps_per_sample;
  for (unsigned int i = 0; i < n; ++i)
  {
    clock.begin_step();
    wait(1e-4);
    clock.lap(blocks);
    if (i % 10 == 0)
      clock.measure(output, [] { wait(1e-3); });
    wait(2e-4);
    clock.lap(joints);
  }
  const double all = seconds_since(start);
  // The machine may hold the process up, in a measured step 17 times.
  EXPECT_GE(clock.time(blocks), n * 1e-4 * (1. - 1e-9));
  EXPECT_GE(clock.time(joints), n * 2e-4 * (1. - 1e-9));
  EXPECT_GE(clock.time(output), 17 * 1e-3 * (1. - 1e-9));
  EXPECT_LT(clock.time(output), all);
  EXPECT_EQ(clock.phases().size(), 3U);
}
