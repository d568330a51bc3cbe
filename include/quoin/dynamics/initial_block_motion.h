// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_initial_block_motion_h
#define quoin_dynamics_initial_block_motion_h

#include <quoin/dynamics/solver.h>
#include <quoin/model/named_blocks.h>

#include <vector>

namespace quoin
{
  /**
   * Adds the velocity and the spin of @p blocks to those of @p state at t = 0,
   * which has been prepared by @p solver: v_i = v + spin x (x_i - x_c) for
   * their nodes, ghosts included, and the degrees of freedom of rigid ones;
   * x_c is the centroid where the block is in @p state. Collective. Throws an
   * InputError about a block that is absent, or that a load of the stage
   * @p first holds or drives.
   */
  void start_blocks(const std::vector<NamedBlock> &blocks,
                    const Model<2> &model, const Solver<2> &solver,
                    const StageParameters &first, State<2> &state);
} // namespace quoin

#endif
