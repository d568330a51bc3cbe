// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_partition_h
#define quoin_mesh_partition_h

#include <quoin/mesh/block_mesh.h>

#include <vector>

namespace quoin
{
  /**
   * The rank that owns each cell of @p mesh, so that costs of cells and joints
   * are shared evenly among @p n_ranks and little lies between ranks. Whole
   * blocks go to ranks where that balances; otherwise METIS divides the graph
   * of blocks, in which large deformable ones are many pieces. Rigid blocks
   * (@p is_rigid, by block) and mixed tetrahedra stay whole.
   */
  template <int dim>
  std::vector<unsigned int> partition_cells(const BlockMesh<dim> &mesh,
                                            const std::vector<bool> &is_rigid,
                                            unsigned int n_ranks);
} // namespace quoin

#endif
