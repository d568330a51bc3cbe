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
  EXPECT_EQ(Interruption(true).received(), 0);
  const Interruption interruption(true);
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
    const Interruption interruption(true);
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

TEST(Interruption, BeforeTheStepsTheFirstRankSaysThatTheProcessEnds)
{
  const auto interrupt = [](const bool is_first_rank)
  {
    const Interruption interruption(is_first_rank);
    std::raise(SIGINT);
  };
  EXPECT_EXIT(interrupt(true), testing::KilledBySignal(SIGINT),
              "^interrupted by SIGINT before the first step: nothing was "
              "computed\n$");
  EXPECT_EXIT(interrupt(false), testing::KilledBySignal(SIGINT), "^$");
}

TEST(Interruption, SignalsEndTheProcessAfterwards)
{
  EXPECT_EXIT(
      {
        {
          const Interruption interruption(true);
          Interruption::begin_steps();
        }
        std::raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
}
