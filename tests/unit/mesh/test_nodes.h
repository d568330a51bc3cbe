// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_mesh_test_nodes_h
#define quoin_tests_unit_mesh_test_nodes_h

#include <quoin/blocks/rigid_blocks.h>
#include <quoin/mesh/node_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace quoin::test
{
  /**
   * The nodes of a mesh that is all on one rank, with the triangulation that
   * they refer to. But for midside nodes and what comes with them nodes, cells
   * and faces have the numbers that they have in the BlockMesh.
   */
  class TestNodes
  {
  public:
    /** @p is_rigid: of each block; empty: none is. Rigid ones come last. */
    explicit TestNodes(BlockMesh<2> mesh,
                       const std::vector<bool> &is_rigid = {})
      : blocks(mesh, std::vector<unsigned int>(mesh.n_cells(), 0),
               is_rigid.empty() ? std::vector<bool>(mesh.n_blocks(), false)
                                : is_rigid,
               MPI_COMM_SELF),
        nodes(blocks)
    {
      EXPECT_TRUE(std::is_sorted(is_rigid.begin(), is_rigid.end()));
    }

    /** Blocks are rigid by the materials of their groups. */
    TestNodes(const BlockMesh<2> &mesh,
              const std::vector<MaterialParameters> &materials)
      : TestNodes(mesh, find_rigid_blocks(mesh, materials))
    {
    }

    TestNodes(const TestNodes &)            = delete;
    TestNodes &operator=(const TestNodes &) = delete;

    operator const NodeMap<2> &() const
    {
      return nodes;
    }
    const NodeMap<2> &operator*() const
    {
      return nodes;
    }
    const NodeMap<2> *operator->() const
    {
      return &nodes;
    }

  private:
    const BlockTriangulation<2> blocks;
    const NodeMap<2> nodes;
  };

  /** Nodes at a place, whatever their blocks. */
  inline std::vector<unsigned int> nodes_at(const NodeMap<2> &nodes,
                                            const double x, const double y)
  {
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      if (nodes.point(i).distance(dealii::Point<2>(x, y)) < 1e-3)
        result.push_back(i);
    return result;
  }

  /** Nodes [begin, end) of a block. */
  inline std::array<unsigned int, 2> nodes_of_block(const NodeMap<2> &nodes,
                                                    const unsigned int block)
  {
    return nodes.blocks().parts.at(nodes.blocks().find(block)).nodes;
  }
} // namespace quoin::test

#endif
