// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_contact_bounds_h
#define quoin_model_contact_bounds_h

#include <quoin/joint_elements/pair_dashpots.h>
#include <quoin/model/model.h>

#include <cstdint>
#include <vector>

namespace quoin
{
  /** Mass of each block of the mesh [kg], without mass scaling. Collective. */
  template <int dim>
  std::vector<double> block_masses(const NodeMap<dim> &nodes,
                                   const std::vector<double> &node_mass);

  /** The largest mass that dashpots between each block and those that it meets
      can have [kg], see PairDashpots: its own, or if a load holds it theirs.
      Entry b n + s is that of set s of n at block b of the mesh; 0: the set has
      none there. Collective. */
  template <int dim>
  std::vector<double> dashpot_masses(const Model<dim> &model);

  /** P and S wave impedance of each cell group [Pa s/m]; infinite: rigid. */
  std::vector<std::array<double, 2>>
  group_impedances(const ModelProperties &properties, PlaneAssumption plane);

  /** Data of the blocks for dashpots. Collective. */
  template <int dim>
  DashpotBlocks dashpot_blocks(const Model<dim> &model);

  /** sets_on_blocks() of the joints or, if blocks may meet anywhere,
      ContactLaws::sets_on_blocks(). Collective. */
  template <int dim>
  std::vector<std::uint8_t> sets_on_blocks(const Model<dim> &model);
} // namespace quoin

#endif
