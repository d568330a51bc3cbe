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

  /** Whether a block beside face @p joint of the joints is absent. */
  template <int dim>
  bool is_at_absent_block(const Model<dim> &model, unsigned int joint,
                          const State<dim> &state);

  /** Leaves @p blocks where they are, without strain and motion. Collective. */
  template <int dim>
  void bring_to_rest(const Model<dim> &model,
                     const std::vector<unsigned int> &blocks,
                     State<dim> &state);

  /** Puts @p blocks in their reference position, without strain and motion.
      Collective. */
  template <int dim>
  void place_blocks(const Model<dim> &model,
                    const std::vector<unsigned int> &blocks, State<dim> &state);
} // namespace quoin

#endif
