// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>

#include <gtest/gtest.h>

using namespace quoin;

TEST(DisjointSets, AreNamedByTheirSmallestMembers)
{
  // {0}, {1, 3, 5}, {2, 4}, in any order of unions.
  DisjointSets one(6), other(6);
  one.unite(5, 3);
  one.unite(3, 1);
  one.unite(4, 2);
  other.unite(2, 4);
  other.unite(1, 5);
  other.unite(5, 3);
  for (DisjointSets *sets : { &one, &other })
  {
    EXPECT_EQ(sets->find(5), 1U);
    EXPECT_EQ(sets->find(4), 2U);
    const auto [number, n] = sets->numbers();
    EXPECT_EQ(number, (std::vector<unsigned int>{ 0, 1, 2, 1, 2, 1 }));
    EXPECT_EQ(n, 3U);
  }
}
