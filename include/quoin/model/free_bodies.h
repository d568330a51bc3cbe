// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_free_bodies_h
#define quoin_model_free_bodies_h

#include <quoin/model/model.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/motions/motion_constraint.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Throws an InputError naming the first body (blocks that joints tie
   * together) with a rigid body mode that the prescribed degrees of freedom of
   * @p constraints leave free: it could never reach equilibrium. Blocks that
   * are absent in @p state do not count. @p stage is for the message.
   * Collective.
   */
  template <int dim>
  void
  check_no_free_bodies(const Model<dim> &model,
                       const std::vector<MotionConstraint<dim> *> &constraints,
                       const std::string &stage, const State<dim> &state);

  /** A body that loads push along an unrestrained rigid body mode. */
  template <int dim>
  struct UnsupportedBody
  {
    unsigned int block;    /**< first block of the body */
    unsigned int n_blocks; /**< number of its blocks */
    /** Centroid of this block of the first body [m]. */
    dealii::Point<dim> centre;
    bool is_loose; /**< whether all of its rigid body modes are free */
  };

  /**
   * The bodies of check_no_free_bodies() to which @p loads give a force or
   * moment, at one of @p times, along an unrestrained rigid body mode. Here
   * viscous boundaries, free fields and boundary elements count as restraints
   * too. Collective.
   */
  template <int dim>
  std::vector<UnsupportedBody<dim>> find_unsupported_bodies(
      const Model<dim> &model,
      const std::vector<MotionConstraint<dim> *> &constraints,
      const std::vector<const NodalLoad<dim> *> &loads,
      const std::vector<TimePoint> &times, const State<dim> &state);

  /** Warning that @p bodies, at least one, will move away. */
  template <int dim>
  std::string
  unsupported_body_text(const std::vector<UnsupportedBody<dim>> &bodies);
} // namespace quoin

#endif
