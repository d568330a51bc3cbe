// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_named_blocks_h
#define quoin_model_named_blocks_h

#include <quoin/base/parameter_section.h>
#include <quoin/model/model.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * A block with a name, by which histories record its motion and the forces
   * between it and others, and its motion at the start: a subsection of
   * 'Blocks'.
   */
  struct NamedBlock
  {
    std::string name;
    bool has_point = false;
    dealii::Point<2> point; /**< point in the block at rest [m] */
    std::string group;      /**< physical surface of this block alone */
    /** Velocity of the centroid at t = 0 [m/s]. */
    dealii::Tensor<1, 2> velocity;
    /** Spin about the centroid at t = 0, anticlockwise [rad/s]. */
    double spin = 0.;
    /** Number in the whole mesh; find_named_blocks(). */
    unsigned int number = -1;

    /** Whether it moves at the start of the run. */
    bool moves() const
    {
      return velocity.norm_square() > 0. || spin != 0.;
    }

    static void declare(dealii::ParameterHandler &prm);
    static NamedBlock read(const ParameterSection &section,
                           const std::string &name);
  };

  /**
   * Finds the numbers of @p blocks in the whole mesh, where @p nodes are at
   * rest. Collective. Throws an InputError about a point in no block or on the
   * edge of several, a surface that does not exist or has several blocks, and a
   * block with two names.
   */
  void find_named_blocks(const NodeMap<2> &nodes,
                         std::vector<NamedBlock> &blocks);

  /** Mass [kg], centroid [m] and moment of inertia about it [kg m^2] of a block
      at rest; those of the lumped masses if the block is deformable. */
  struct BlockInertia
  {
    double mass = 0.;
    dealii::Point<2> centroid;
    double moment = 0.;
  };
  /** Inertia of @p block of the whole mesh; collective. */
  BlockInertia inertia_of_block(const Model<2> &model, unsigned int block);

  /** A line on each of @p blocks for the log; collective. */
  std::vector<std::string>
  named_block_lines(const Model<2> &model,
                    const std::vector<NamedBlock> &blocks);
} // namespace quoin

#endif
