// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_contact_bounds_h
#define quoin_model_contact_bounds_h

#include <quoin/contact/pair_dashpots.h>
#include <quoin/model/model.h>

#include <cstdint>
#include <vector>

namespace quoin
{
  /** Mass of each block of the mesh [kg], without mass scaling. Collective. */
  std::vector<double> block_masses(const NodeMap<2> &nodes,
                                   const std::vector<double> &node_mass);

  /** P and S wave impedance of each cell group [Pa s/m]; infinite: rigid. */
  std::vector<std::array<double, 2>>
  group_impedances(const ModelProperties &properties, PlaneAssumption plane);

  /** Data of the blocks for dashpots; @p is_held marks blocks that a load holds
      or moves, on any rank. Collective. */
  DashpotBlocks dashpot_blocks(const Model<2> &model,
                               std::vector<std::uint8_t> is_held);

  /**
   * Which joint sets act on each block, or may once it touches others: entry
   * b n + s is 1 if set s of n does on block b. Those of its joints and, if
   * @p may_meet, those of new contacts of its materials with any that are in
   * the mesh. Collective.
   */
  std::vector<std::uint8_t> sets_on_blocks(const NodeMap<2> &nodes,
                                           const MatchedJoints &joints,
                                           const ModelProperties &properties,
                                           bool may_meet);
} // namespace quoin

#endif
