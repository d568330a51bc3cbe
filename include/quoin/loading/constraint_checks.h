// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_constraint_checks_h
#define quoin_loading_constraint_checks_h

#include <quoin/motions/motion_constraint.h>
#include <quoin/model/model.h>
#include <quoin/stages/stage_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  // What the @p constraints that act in @p stage may not do together; each
  // throws an InputError. Collective.

  /** Refuses constraints of blocks that are absent in @p state, except
      prescribed motions. */
  template <int dim>
  void
  refuse_absent_nodes(const Model<dim> &model,
                      const std::vector<MotionConstraint<dim> *> &constraints,
                      const StageParameters &stage, const State<dim> &state);

  /** Refuses two platens that share a node. */
  template <int dim>
  void
  refuse_shared_platens(const Model<dim> &model,
                        const std::vector<MotionConstraint<dim> *> &constraints,
                        const StageParameters &stage);

  /** A sentence about a component of a prescribed motion that is lost, as a
      platen moves its nodes and leaves the component free or loads it; empty:
      there is none. Collective. */
  template <int dim>
  std::string
  lost_motion_text(const Model<dim> &model,
                   const std::vector<MotionConstraint<dim> *> &constraints);

  /** The rigid blocks that platens move; refuses one that is held in part or by
      something else. */
  std::vector<bool>
  find_held_blocks(const Model<2> &model,
                   const std::vector<MotionConstraint<2> *> &constraints,
                   const StageParameters &stage);
} // namespace quoin

#endif
