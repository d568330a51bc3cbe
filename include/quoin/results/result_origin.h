// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_result_origin_h
#define quoin_results_result_origin_h

#include <quoin/base/archive_members.h>
#include <quoin/stages/stage_parameters.h>
#include <quoin/joints/joint_history.h>
#include <quoin/model/model.h>
#include <quoin/operators/state.h>

#include <cstdint>

namespace quoin
{
  /**
   * What displacements, slips and states of joints in results count from, if
   * not from the start of the run: their values where a stage with a
   * ResultReset began. No force and no decision of a solver depends on it. Each
   * array is empty if its results were never reset.
   */
  template <int dim>
  struct ResultOrigin
  {
    static constexpr const char *slice_name = "origin of results";

    /** Displacement of local nodes [m]. */
    AlignedArray<dealii::Tensor<1, dim>> displacement;
    /** Slip of joint points, its dim - 1 components [m]. */
    AlignedArray<double> slip;
    /** Whether each joint point was intact where a stage began, or has slipped
        or been open since the origin: all that it has been through counts. */
    AlignedArray<std::uint8_t> has_failed;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.nodes(displacement);
      visitor.own(slip, dim * (dim - 1), JointHistoryOf<dim>::slice_name);
      visitor.own(has_failed, dim, JointHistoryOf<dim>::slice_name);
    }
  };

  /** Notes which joints slip or are open by @p state: in each step after the
      origin, those of an explicit one before the next. */
  template <int dim>
  void note_failed_joints(State<dim> &state);

  /**
   * Counts what @p reset names from @p state on, where a stage begins, after
   * construction. What is absent counts from where it comes again. Internal
   * variables are those of the positions.
   */
  template <int dim>
  void count_from(const Model<dim> &model, const ResultReset &reset,
                  State<dim> &state);

  /** The state of joint point @p p by what it has been through since the
      origin; that of now is no matter of the origin. */
  template <int dim>
  JointState state_since_origin(const State<dim> &state, unsigned int p);

  /** Component @p d of the slip of joint point @p p where the origin was
      [m]. */
  template <int dim>
  double slip_at_origin(const State<dim> &state, const unsigned int p,
                        const unsigned int d = 0)
  {
    const auto *origin = state.template find<ResultOrigin<dim>>();
    return origin && !origin->slip.empty() ? origin->slip[(dim - 1) * p + d]
                                           : 0.;
  }
} // namespace quoin

#endif
