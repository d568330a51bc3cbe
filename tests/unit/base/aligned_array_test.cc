// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/aligned_array.h>

#include <gtest/gtest.h>

#include <cstdint>

using namespace quoin;

// Arrays of both kinds of memory keep their numbers as they grow.
TEST(AlignedArray, IsAlignedAndKeepsItsNumbers)
{
  AlignedArray<double> array;
  for (const std::size_t n : { 1U, 1000U, 524287U, 524288U, 2000000U, 10U })
  {
    array.resize(n, 1.5);
    array.shrink_to_fit();
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0U);
    EXPECT_EQ(array.front(), 1.5);
    EXPECT_EQ(array.back(), 1.5);
  }
  const AlignedArray<double> copy = array;
  EXPECT_EQ(copy, array);
}
