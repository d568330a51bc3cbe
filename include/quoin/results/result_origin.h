// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_result_origin_h
#define quoin_results_result_origin_h

#include <quoin/base/archive_members.h>
#include <quoin/dynamics/stage_parameters.h>
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
   *
   * What a joint has been through is in no single number: one that has failed
   * before, is closed and sticks has failed since as well if its inelastic slip
   * or opening is another one.
   */
  template <int dim>
  struct ResultOrigin
  {
    static constexpr const char *slice_name = "origin of results";

    AlignedArray<NodeVector<dim>> displacement; /**< of local nodes [m] */
    // Of joint points.
    AlignedArray<double> slip; /**< [m] */
    /** Inelastic slip and opening where the present stage began [m]. */
    AlignedArray<double> plastic_slip, plastic_opening;
    /** Whether all that the point has been through came since, as of that
        time: it was intact, or it has failed since. */
    AlignedArray<std::uint8_t> is_since;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.nodes(displacement);
      for (AlignedArray<double> *array :
           { &slip, &plastic_slip, &plastic_opening })
        visitor.own(*array, 2, JointHistory::slice_name);
      visitor.own(is_since, 2, JointHistory::slice_name);
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive_members(archive, *this);
    }
  };

  // Internal variables of the state must be those of its positions.

  /** Notes which joints have failed so far, where a stage ends: construction
      may change them before the next one. */
  template <int dim>
  void note_failed_joints(State<dim> &state);

  /**
   * Counts what @p reset names from @p state on, where a stage begins, after
   * construction. What is absent counts from where it comes again.
   */
  template <int dim>
  void count_from(const Model<dim> &model, const ResultReset &reset,
                  State<dim> &state);

  /** The state of joint point @p p by what it has been through since the
      origin; that of now is no matter of the origin. */
  JointState state_since_origin(const State<2> &state, unsigned int p);

  /** The slip of joint point @p p where the origin was [m]. */
  inline double slip_at_origin(const State<2> &state, const unsigned int p)
  {
    const auto *origin = state.find<ResultOrigin<2>>();
    return origin && !origin->slip.empty() ? origin->slip[p] : 0.;
  }
} // namespace quoin

#endif
