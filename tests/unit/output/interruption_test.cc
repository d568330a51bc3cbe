// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/interruption.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

using namespace quoin;

TEST(Interruption, TakesTheFirstSignal)
{
  Interruption::begin(true);
  EXPECT_EQ(Interruption::received(), 0);
  Interruption::begin_steps();
  std::raise(SIGTERM);
  EXPECT_EQ(Interruption::received(), SIGTERM);
  // One that comes at once is the same request.
  std::raise(SIGINT);
  EXPECT_EQ(Interruption::received(), SIGTERM);
  EXPECT_EQ(signal_name(SIGTERM), "SIGTERM");
}

TEST(Interruption, SecondSignalEndsTheProcess)
{
  const auto interrupt_twice = []()
  {
    Interruption::begin(true);
    Interruption::begin_steps();
    std::raise(SIGTERM);
    // mpirun may take as long to pass the first one on once more.
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::raise(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::raise(SIGINT);
  };
  EXPECT_EXIT(interrupt_twice(), testing::KilledBySignal(SIGINT), "");
}

TEST(Interruption, BeforeTheStepsTheFirstRankEndsTheProcess)
{
  const auto interrupt = []()
  {
    Interruption::begin(true);
    std::raise(SIGINT);
  };
  EXPECT_EXIT(interrupt(), testing::KilledBySignal(SIGINT),
              "^interrupted by SIGINT before the first step: nothing was "
              "computed\n$");
}

TEST(Interruption, OtherRanksNoteSignalsBeforeTheSteps)
{
  // The first rank may have begun to step: it decides.
  Interruption::begin(false);
  std::raise(SIGUSR1);
  Interruption::begin_steps();
  EXPECT_EQ(Interruption::received(), SIGUSR1);
}
