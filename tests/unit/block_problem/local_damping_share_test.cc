// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// When a stage with local damping warns that its motion is not that of an
// equilibrium.

#include <quoin/block_problem/block_stage.h>

#include <gtest/gtest.h>

using quoin::LocalDampingShare;

TEST(LocalDampingShare, FallsAreMotion)
{
  LocalDampingShare fall;
  for (unsigned int row = 0; row < 100; ++row)
    fall.add_row(row < 40 ? 0.2 : 0.);
  EXPECT_TRUE(fall.is_of_motion());
}

TEST(LocalDampingShare, SettlingIsNot)
{
  // Some rows at the start, however many follow, or few in all.
  LocalDampingShare settling;
  for (unsigned int row = 0; row < 1000; ++row)
    settling.add_row(row < 12 ? 0.5 : 1e-4);
  EXPECT_FALSE(settling.is_of_motion());
  LocalDampingShare few;
  for (unsigned int row = 0; row < 9; ++row)
    few.add_row(0.5);
  EXPECT_FALSE(few.is_of_motion());
}

TEST(LocalDampingShare, LoadsThatAreOpposedForMostOfAStageAreLarge)
{
  LocalDampingShare share;
  for (unsigned int sample = 0; sample < 100; ++sample)
    share.add(sample < 51 ? 0.006 : 0.);
  EXPECT_TRUE(share.is_large());
  EXPECT_FALSE(share.is_of_motion());
}
