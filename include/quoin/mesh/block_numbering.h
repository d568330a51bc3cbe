// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_block_numbering_h
#define quoin_mesh_block_numbering_h

#include <quoin/mesh/block_mesh.h>

#include <vector>

namespace quoin
{
  /**
   * Give a mesh whose cells and vertices come in any order the numbering that
   * BlockMesh describes and fill block_first_cell and block_first_vertex.
   * Within a block cells follow a Hilbert curve; vertices follow the block's
   * boundary first, then the cells: a random order costs the block kernel a
   * factor of two to three.
   *
   * @p block_of_cell has one entry per cell, from 0 to @p n_blocks - 1.
   */
  void number_blocks(BlockMesh<2> &mesh,
                     const std::vector<unsigned int> &block_of_cell,
                     const unsigned int n_blocks);

  /**
   * Permute the blocks: new block i is old block new_order[i]. The order within
   * blocks stays.
   */
  void renumber_blocks(BlockMesh<2> &mesh,
                       const std::vector<unsigned int> &new_order);

  /**
   * Distribute whole blocks to @p n_parts parts of about equal numbers of cells
   * with few pairs of blocks joined across parts; returns the part of each
   * block. With at least as many parts as blocks, block i goes to part i and
   * the other parts are empty. METIS divides the graph of blocks and joints; if
   * that leaves a part more than a tenth above what dealing out the blocks by
   * size alone gives (few blocks of very different size), the latter is taken.
   */
  std::vector<unsigned int> partition_blocks(const BlockMesh<2> &mesh,
                                             const unsigned int n_parts);

  /**
   * The order for renumber_blocks that makes the blocks of each part
   * consecutive. Within parts the order stays, but blocks that @p behind marks
   * (none, if it is empty) come behind the others.
   */
  std::vector<unsigned int>
  order_by_part(const std::vector<unsigned int> &part_of_block,
                const std::vector<bool> &behind = {});
} // namespace quoin

#endif
