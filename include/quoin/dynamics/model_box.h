// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_model_box_h
#define quoin_dynamics_model_box_h

#include <quoin/dynamics/model.h>

#include <array>
#include <vector>

namespace quoin
{
  /** A block that was found outside the box. */
  struct BlockOutside
  {
    unsigned int block;             /**< of the whole mesh */
    std::array<double, 2> position; /**< mean of its nodes now [m] */
    double time;                    /**< when it was found [s] */
    bool removed;                   /**< or only reported */
  };

  /**
   * The box of 'Contact/Box', which blocks should not leave. A block has left
   * it when all of its nodes are outside. It is to be removed if no load of
   * this or a later stage moves it, and so for all blocks that matched joints
   * tie to it: those that have not come apart leave together or not at all.
   */
  class ModelBox
  {
  public:
    /**
     * Keeps a reference to @p model. Throws an InputError if a block is
     * outside from the start.
     */
    explicit ModelBox(const Model &model);

    bool is_given() const
    {
      return parameters.has_box;
    }

    /**
     * Looks for blocks that have left since the last look and marks them in
     * State::block_marks, which all ranks know of all blocks. Returns them
     * in ascending order, the same on all ranks; the caller removes those that
     * are marked so. Collective. @p moved: whether loads move the block, for
     * each block of this rank. Throws a RunError if no block may leave.
     */
    std::vector<BlockOutside> look(State<2> &state,
                                   const std::vector<bool> &moved) const;

  private:
    bool is_outside(unsigned int block, const State<2> &state) const;
    /** A block that is tied to one that stays, stays. */
    void spread_along_joints(std::vector<std::uint8_t> &stays,
                             const State<2> &state) const;
    void find_positions(std::vector<BlockOutside> &found,
                        const State<2> &state) const;

    const Model &model;
    const ContactParameters &parameters;
  };
} // namespace quoin

#endif
