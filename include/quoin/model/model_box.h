// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_model_box_h
#define quoin_model_model_box_h

#include <quoin/base/exceptions.h>
#include <quoin/model/model.h>

#include <array>
#include <vector>

namespace quoin
{
  /** The failure of a model of which a block has left the box. */
  class BlockLeftBox : public ModelFailure
  {
  public:
    using ModelFailure::ModelFailure;
  };

  /** A block that was found outside the box. */
  struct BlockOutside
  {
    unsigned int block;            /**< number of the block in the whole mesh */
    dealii::Point<2> position;     /**< mean of its nodes now [m] */
    dealii::Tensor<1, 2> velocity; /**< mean of its nodes [m/s] */
    double time;                   /**< time of detection [s] */
    bool removed; /**< whether the block was removed or only reported */
  };

  /**
   * The box of 'Contact/Box', which blocks should not leave. A block has left
   * it when all of its nodes are outside. It is removed if no load of this or a
   * later stage moves it, and if the same holds for all blocks that intact
   * matched joints tie to it.
   */
  class ModelBox
  {
  public:
    /**
     * Keeps a reference to @p model, which has a box. Throws an InputError if a
     * block is outside from the start.
     */
    explicit ModelBox(const Model<2> &model);

    /**
     * Finds blocks that have left since the last call and marks them in
     * State::block_marks, which has all blocks on all ranks. Returns them in
     * ascending order, the same on all ranks; the caller removes those marked
     * for removal. Collective. @p moved: whether loads move the block, for each
     * block of this rank. Throws a RunError if no block may leave.
     */
    std::vector<BlockOutside>
    find_outside(State<2> &state, const std::vector<bool> &moved) const;

  private:
    /** Marks the blocks tied to one that stays as staying. */
    void spread_along_joints(std::vector<std::uint8_t> &stays,
                             const State<2> &state) const;
    void find_motions(std::vector<BlockOutside> &found,
                      const State<2> &state) const;

    const Model<2> &model;
    const ContactParameters &parameters;
  };
} // namespace quoin

#endif
