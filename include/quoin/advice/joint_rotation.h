// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_joint_rotation_h
#define quoin_advice_joint_rotation_h

#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  /** The joint of one name between two blocks. */
  struct BlockJoint
  {
    unsigned int name; /**< index into BlockTable::face_names */
    unsigned int blocks[2];
    unsigned int n_faces;
    /** By how much nodal quadrature makes it too stiff, while it is closed, in
        that rotation of rigid blocks against each other of which it does so
        most [-] (theory.md, "Nodal quadrature"): 2/n^2 for n equal faces in a
        line. */
    double excess;
  };

  /** All joints between two blocks of plain linear cells, on all ranks;
      @p only_rigid: those between two rigid ones, where @p is_rigid has an
      entry for each block. Collective. */
  template <int dim>
  std::vector<BlockJoint> block_joints(const NodeMap<dim> &nodes,
                                       const std::vector<bool> &is_rigid,
                                       bool only_rigid);
} // namespace quoin

#endif
