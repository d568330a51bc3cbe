// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_block_placement_h
#define quoin_model_block_placement_h

#include <quoin/model/model.h>

#include <vector>

namespace quoin
{
  // Blocks that are placed, stopped and excavated. Numbers of blocks are those
  // of the whole mesh.

  /** Nodes of @p block that this rank owns. */
  template <int dim>
  std::vector<unsigned int> owned_nodes(const Model<dim> &model,
                                        unsigned int block);

  /** Local nodes of @p block without those that other ranks share. */
  template <int dim>
  NodeRange block_nodes(const Model<dim> &model, unsigned int block);

  /** Index of @p block, which this rank has, into Model::rigid_blocks(). */
  template <int dim>
  unsigned int rigid_number(const Model<dim> &model, unsigned int block);

  /** Whether the block of each local node is absent in @p state. */
  template <int dim>
  std::vector<bool> absent_nodes(const Model<dim> &model,
                                 const State<dim> &state);

  /** Whether a block beside joint segment @p segment is absent. */
  bool is_at_absent_block(const Model<2> &model, unsigned int segment,
                          const State<2> &state);

  /** Leaves @p blocks where they are, without strain and motion. Collective. */
  void bring_to_rest(const Model<2> &model,
                     const std::vector<unsigned int> &blocks, State<2> &state);

  /** Puts @p blocks in their reference position, without strain and motion.
      Collective. */
  void place_blocks(const Model<2> &model,
                    const std::vector<unsigned int> &blocks, State<2> &state);
} // namespace quoin

#endif
