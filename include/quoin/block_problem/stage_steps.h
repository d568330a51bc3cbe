// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_stage_steps_h
#define quoin_block_problem_stage_steps_h

#include <quoin/farfield/incident_waves.h>
#include <quoin/block_problem/block_system.h>
#include <quoin/output/log.h>

#include <cstdint>
#include <memory>

namespace quoin
{
  /**
   * Chooses the time step of a stage of the explicit solver, that of the
   * boundary elements beyond the blocks, and the number of steps.
   */
  template <int dim>
  class StageSteps
  {
  public:
    StageSteps(BlockSystem<dim> &system, Log &log);

    /**
     * Chooses for a @p stage that has begun. Boundary elements prepare their
     * operators in the first one in which they act; collective. Throws an
     * InputError about steps that are too long or too many.
     */
    void choose(const StageParameters &stage);

    /** Number of steps of a stage that ends by time; otherwise 0. */
    std::uint64_t n_steps() const
    {
      return steps_of_stage;
    }

  private:
    /**
     * Makes a step of the boundary elements a whole number of block steps not
     * longer than @p dt; returns the block step [s].
     */
    double choose_far_field_step(const StageParameters &stage, double dt);
    void make_waves(double step);
    void report_far_field();

    BlockSystem<dim> &system;
    const Parameters &parameters;
    Log &log;
    std::unique_ptr<IncidentWaves> waves;
    std::uint64_t steps_of_stage = 0;
  };

  // Members that exist in two dimensions only.
  template <>
  double StageSteps<2>::choose_far_field_step(const StageParameters &stage,
                                              double dt);
  template <>
  void StageSteps<2>::make_waves(double step);
  template <>
  void StageSteps<2>::report_far_field();
} // namespace quoin

#endif
