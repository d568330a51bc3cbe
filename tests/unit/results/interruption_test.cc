// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/interruption.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

using namespace quoin;

TEST(Interruption, TakesTheFirstSignal)
{
  EXPECT_EQ(Interruption().received(), 0);
  const Interruption interruption;
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
    const Interruption interruption;
    std::raise(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    std::raise(SIGINT);
  };
  EXPECT_EXIT(interrupt_twice(), testing::KilledBySignal(SIGINT), "");
}

TEST(Interruption, SignalsEndTheProcessBeforeAndAfter)
{
  EXPECT_EXIT(
      {
        {
          const Interruption interruption;
        }
        std::raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
}
