// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_field_output_h
#define quoin_results_field_output_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/results/boundary_histories.h>
#include <quoin/operators/state.h>
#include <quoin/farfield/far_field.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/model/model.h>
#include <quoin/results/block_output.h>
#include <quoin/results/boundary_output.h>
#include <quoin/results/joint_output.h>
#include <quoin/water/joint_flow.h>

namespace quoin
{
  /** Fields of the blocks of this rank for blocks.pvd. */
  template <int dim>
  BlockFields<dim> block_fields(const Model<dim> &model,
                                const State<dim> &state);

  /** Component @p component of the water at @p point of the joints of this
      rank: pressure [Pa], hydraulic aperture [m], flow [m^3/s] or its velocity
      [m/s], both positive to the right or, in vertical joints, upwards;
      saturation [-]. */
  double flow_value(const Model<2> &model, const JointFlowState &water,
                    unsigned int point, unsigned int component);

  /**
   * Fields of the matched joints of this rank, those handed over to general
   * contacts included: they have opening and slip of their two sides, the law's
   * fields when it was, and no tractions, which the contact has. @p state:
   * after Solver::update_histories().
   */
  JointFields joint_fields(const Model<2> &model, const State<2> &state);
  SpaceJointFields joint_fields(const Model<3> &model, const State<3> &state);

  /** Fields of the general contacts of this rank, for the same state. */
  JointFields contact_fields(const MatchedJoints &joints,
                             const BlockContacts &contacts,
                             const State<2> &state);

  /** The total field on the boundary after the far field's last step. */
  BoundaryState boundary_state(const FarField &far, const State<2> &state);

  /** Fields of boundary elements for boundary.pvd. */
  BoundaryFields boundary_fields(const BoundaryGeometry &geometry,
                                 const BoundaryState &state);

  /** Size of blocks.pvd and joints.pvd for one output time, of all ranks [B];
      collective. */
  template <int dim>
  double bytes_of_fields(const Model<dim> &model);
} // namespace quoin

#endif
