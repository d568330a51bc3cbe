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
   * Within a block cells follow a Hilbert curve; vertices on the boundary come
   * first, in two dimensions along it, in three along the cells, then the
   * others along the cells: a random order costs the block kernel a
   * factor of two to three.
   *
   * @p block_of_cell has one entry per cell, from 0 to @p n_blocks - 1.
   */
  template <int dim>
  void number_blocks(BlockMesh<dim> &mesh,
                     const std::vector<unsigned int> &block_of_cell,
                     const unsigned int n_blocks);

  /**
   * Permute the blocks: new block i is old block new_order[i]. The order within
   * blocks stays.
   */
  template <int dim>
  void renumber_blocks(BlockMesh<dim> &mesh,
                       const std::vector<unsigned int> &new_order);

  /**
   * The order for renumber_blocks that puts the blocks which @p is_rigid marks
   * behind the others.
   */
  std::vector<unsigned int> order_rigid_last(const std::vector<bool> &is_rigid);
} // namespace quoin

#endif
