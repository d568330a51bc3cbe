// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "tetrahedron_blocks.h"

#include <quoin/blocks/tetrahedron_pairs.h>
#include <quoin/mesh/mixed_tetrahedra.h>

#include <gtest/gtest.h>

#include <set>

using namespace quoin;
using namespace quoin::test;

namespace
{
  std::set<unsigned int> sorted(const std::array<unsigned int, 4> &nodes)
  {
    return { nodes.begin(), nodes.end() };
  }

  /** The cells of a cluster by the order of nodes in which the kernel takes
      them. */
  std::array<std::array<unsigned int, 4>, 2>
  cells_of(const TetrahedronCluster &cluster)
  {
    const auto &n = cluster.nodes;
    return { { { n[0], n[1], n[2], n[3] }, { n[0], n[2], n[1], n[4] } } };
  }
} // namespace

TEST(TetrahedronPairs, EachCellComesOnceWithItsNodesAndItsVolume)
{
  TetrahedronBlocks mesh;
  mesh.add_box({ 5, 4, 3 }, { 1., 1., 1. }, Vector3d::Zero(), 0.2);
  mesh.add_box({ 1, 1, 1 }, { 1., 1., 1. }, { 2., 0., 0. });
  const auto &cells = mesh.data.cells;
  const std::vector<std::array<unsigned int, 4>> all(cells.begin(),
                                                     cells.end());
  const auto volume = [&](const std::array<unsigned int, 4> &cell)
  {
    const auto at
        = [&](const unsigned int k) { return vector(mesh.nodes[cell[k]].X); };
    return (at(1) - at(0)).dot((at(2) - at(0)).cross(at(3) - at(0)));
  };
  const TetrahedronPairs found = pair_tetrahedra(all, all.size());
  std::vector<unsigned int> times(all.size());
  const auto check = [&](const TetrahedronCluster &cluster, const unsigned k)
  {
    const unsigned int cell = cluster.cells[k];
    const auto nodes        = cells_of(cluster)[k];
    EXPECT_EQ(sorted(nodes), sorted(all[cell]));
    EXPECT_NEAR(volume(nodes), volume(all[cell]), 1e-15);
    ++times[cell];
  };
  for (const TetrahedronCluster &pair : found.pairs)
    for (unsigned int k = 0; k < 2; ++k)
      check(pair, k);
  for (const TetrahedronCluster &single : found.singles)
    check(single, 0);
  EXPECT_EQ(times, std::vector<unsigned int>(all.size(), 1));
  EXPECT_LT(found.singles.size(), 0.05 * all.size());
}

TEST(TetrahedronPairs, CellsWithoutANeighbourAreSingle)
{
  const TetrahedronPairs found
      = pair_tetrahedra({ { 0, 1, 2, 3 }, { 4, 5, 6, 7 }, { 3, 2, 1, 8 } }, 3);
  ASSERT_EQ(found.pairs.size(), 1u);
  EXPECT_EQ(found.pairs[0].cells[0] + found.pairs[0].cells[1], 2u);
  ASSERT_EQ(found.singles.size(), 1u);
  EXPECT_EQ(found.singles[0].cells[0], 1u);
  EXPECT_TRUE(pair_tetrahedra({}, 1).pairs.empty());
}

TEST(TetrahedronPairs, PartsOfAMixedTetrahedronArePairedAmongThemselves)
{
  // Two tetrahedra, and each of the three diagonals of the octahedron.
  for (const double stretch : { 1., 0.2, 5. })
    for (const double shear : { -0.8, 0.8 })
    {
      MeshData<3> mesh;
      mesh.vertices   = { { 0., 0., 0. },
                          { 1., 0., 0. },
                          { 0., stretch, 0. },
                          { shear, 0., 1. },
                          { 1., stretch, 1. } };
      mesh.cells      = { { 0, 1, 2, 3 }, { 1, 2, 3, 4 } };
      mesh.cell_group = { 0, 0 };
      make_mixed(mesh);
      const TetrahedronPairs found
          = pair_tetrahedra(mesh.cells, parts_of_mixed);
      EXPECT_TRUE(found.singles.empty());
      ASSERT_EQ(found.pairs.size(), parts_of_mixed);
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
        for (const unsigned int cell : found.pairs[k].cells)
          EXPECT_EQ(cell / parts_of_mixed, k / (parts_of_mixed / 2));
    }
}
