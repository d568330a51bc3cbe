// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_free_bodies_h
#define quoin_dynamics_free_bodies_h

#include <quoin/dynamics/model.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/motion_constraint.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Throws an InputError naming the first body, blocks that joints tie
   * together, which the prescribed freedoms of @p constraints leave free to
   * translate or rotate: it could never come to rest. Blocks that are absent in
   * @p state do not count. @p stage is for the message. Collective.
   */
  void
  check_no_free_bodies(const Model &model,
                       const std::vector<MotionConstraint<2> *> &constraints,
                       const std::string &stage, const State<2> &state);

  /** A body that loads push where nothing holds it. */
  struct PushedBody
  {
    unsigned int block;      /**< the first of it */
    unsigned int n_blocks;   /**< that joints tie to it, itself included */
    dealii::Point<2> centre; /**< of the first block [m] */
    bool is_loose;           /**< nothing holds any of its three motions */
  };

  /**
   * The bodies of check_no_free_bodies() to which @p loads give a force or
   * moment, at one of @p times, along a rigid motion that nothing holds. Here
   * boundaries of dashpots, free fields and boundary elements hold too.
   * Collective.
   */
  std::vector<PushedBody> find_pushed_bodies(
      const Model &model, const std::vector<MotionConstraint<2> *> &constraints,
      const std::vector<const NodalLoad<2> *> &loads,
      const std::vector<TimePoint> &times, const State<2> &state);

  /** That @p bodies, of which there is one at least, will move away. */
  std::string pushed_body_text(const std::vector<PushedBody> &bodies);
} // namespace quoin

#endif
