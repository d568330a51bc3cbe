// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_stage_loads_h
#define quoin_loading_stage_loads_h

#include <quoin/model/free_bodies.h>
#include <quoin/loading/arrival.h>
#include <quoin/loading/load_pattern.h>
#include <quoin/loading/release.h>
#include <quoin/stages/stage_parameters.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/structures/beams.h>
#include <quoin/water/joint_flow.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace quoin
{
  /** The loads of a run that act in a stage. Times are load times, from the
      start of the stage. */
  template <int dim>
  struct StageLoads
  {
    /** Constraints in order of action. */
    std::vector<MotionConstraint<dim> *> constraints;
    std::vector<const NodalLoad<dim> *> nodal;
    const Beams *beams = nullptr; /**< with loads of their own; null: none */
    /** Water in the joints, with given values at its boundaries; null: none. */
    const JointFlow *water = nullptr;
    Release<dim> release; /**< release of the forces of excavated blocks */
    Arrival<dim> arrival; /**< growth of the loads on placed blocks */
    /** Loads that one factor scales, beside 'nodal'; null: none. */
    std::shared_ptr<LoadPattern<dim>> pattern;

    /** Values of all of them but the release at @p load_time [s]. */
    std::vector<std::array<double, 5>> values(double stage_start,
                                              double load_time) const;
    /**
     * Whether they have changed in the last @p n_steps explicit steps of
     * @p step [s], or will: a static stage does not end before they are
     * constant and water that is solved every so many steps has followed them.
     * Future times are sampled with a ratio of 1.1: a shorter pulse may be
     * missed.
     */
    bool change(const State<dim> &state, std::uint64_t n_steps,
                double step) const;

    /** When those that grow or are released by themselves have done so [s]. */
    double growth() const;

    /** Throws an InputError about loads that would begin with a jump. */
    void check_start(const State<dim> &state) const;
    /** Throws an InputError about a motion that goes on for ever in @p stage,
        which ends at equilibrium and begins at @p stage_start [s]. */
    void refuse_endless_motion(const StageParameters &stage,
                               double stage_start) const;
    /** Throws a RunError that names a load if it is not finite at @p load_time
        [s] of @p stage. */
    void check_finite(const StageParameters &stage, const State<dim> &state,
                      double load_time) const;

    /**
     * Unsupported bodies that they push in @p stage, begun with @p state; see
     * find_unsupported_bodies().
     */
    std::vector<UnsupportedBody<dim>>
    unsupported_bodies(const Model<dim> &model, const StageParameters &stage,
                       const State<dim> &state) const;
  };
} // namespace quoin

#endif
