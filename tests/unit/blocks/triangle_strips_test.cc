// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "random_blocks.h"

#include <quoin/blocks/triangle_strips.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace quoin;

TEST(TriangleStrips, EachTriangleComesOnceWithItsNodes)
{
  RandomBlocks mesh(6);
  for (const unsigned int m : { 20u, 1u, 2u, 9u })
    mesh.add_block(m, 1.);
  mesh.add_triangle();
  const auto &cells = mesh.data.cells;
  std::vector<unsigned int> members;
  for (unsigned int k = 0; k < cells.size(); ++k)
    if (k % 11 != 3)
      members.push_back(k);

  StripStatistics statistics;
  const auto strips = make_strips(cells, members, &statistics);
  std::vector<unsigned int> found;
  for (std::size_t k = 0; k < strips.size(); ++k)
    if (strips[k].cell != StripEntry::no_cell)
    {
      ASSERT_GE(k, 2u);
      std::array<unsigned int, 3> nodes{ strips[k - 2].node, strips[k - 1].node,
                                         strips[k].node };
      EXPECT_TRUE(std::is_permutation(nodes.begin(), nodes.end(),
                                      cells[strips[k].cell].begin()));
      found.push_back(strips[k].cell);
    }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, members);
  EXPECT_EQ(statistics.n_cells, members.size());
  EXPECT_EQ(strips.size(),
            members.size() + 2 * statistics.n_strips + statistics.n_turns);
}

TEST(TriangleStrips, RegularMeshesGiveWholeRows)
{
  // A row of 30 squares is one strip.
  std::vector<std::array<unsigned int, 3>> cells;
  for (unsigned int i = 0; i < 30; ++i)
  {
    cells.push_back({ i, i + 1, i + 31 });
    cells.push_back({ i + 1, i + 32, i + 31 });
  }
  std::vector<unsigned int> members(cells.size());
  std::iota(members.begin(), members.end(), 0u);
  StripStatistics statistics;
  make_strips(cells, members, &statistics);
  EXPECT_EQ(statistics.n_strips, 1u);
  EXPECT_EQ(statistics.n_turns, 0u);
  EXPECT_EQ(statistics.mean_length(), 60.);
}

TEST(TriangleStrips, NoMembersNoStrips)
{
  StripStatistics statistics;
  EXPECT_TRUE(make_strips({}, {}, &statistics).empty());
  EXPECT_EQ(statistics.mean_length(), 0.);
}
