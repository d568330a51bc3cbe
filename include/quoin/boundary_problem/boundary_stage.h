// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_boundary_problem_boundary_stage_h
#define quoin_boundary_problem_boundary_stage_h

#include <quoin/base/phase_clock.h>
#include <quoin/boundary_problem/boundary_system.h>
#include <quoin/problems/problem.h>
#include <quoin/results/boundary_output.h>
#include <quoin/tdbem/time_marching.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quoin
{
  /** Steps with rows of histories.csv and fields. */
  struct StepControl
  {
    std::function<bool(std::uint64_t)> row_is_due, fields_are_due;
  };

  /** Data of the stages of a problem of boundary elements alone. */
  struct BoundaryContext
  {
    BoundaryContext(const Parameters &parameters, const RunContext &run);

    /** Writes the fields on the boundary at @p time [s]. */
    void write_boundary(double time, const BoundaryState &fields);

    /** Runs @p task and books its time as that of the phase @p name; returns
        that time [s]. */
    template <typename Task>
    double measured(const std::string &name, const Task &task)
    {
      const unsigned int phase = time_spent.phase(name);
      const double before      = time_spent.time(phase);
      time_spent.measure(phase, task);
      return time_spent.time(phase) - before;
    }

    const RunContext &run;
    const BoundaryElementParameters &settings;
    BoundarySystem system;
    const StepControl control;
    RootTable &history_table;
    BoundaryOutput boundary_output;
    PhaseClock time_spent; /**< of this process */
    double seconds = 0.;   /**< before the first step, of time_spent [s] */

    /** State in a checkpoint. */
    struct State
    {
      std::uint64_t step = 0;   /**< steps taken */
      SavedHistory history;     /**< result of BoundaryHistory::save() */
      std::vector<double> u, p; /**< scattered, of the last step */
      /** Displacements and tractions of all steps, one degree of freedom after
          the other, if results in the domain are needed. */
      std::vector<double> all_u, all_p;
      /** Rows of histories.csv that lack the results in the domain. */
      std::vector<double> rows;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &step &history &u &p &all_u &all_p &rows;
      }
    } state;

    std::unique_ptr<TimeMarching> marching; /**< during the time marching */
    /** Solution of a static analysis. */
    std::optional<StaticSolution> solution;
    std::uint64_t n_done = 0;  /**< steps of this process */
    double march_seconds = 0.; /**< wall-clock time of these steps [s] */
  };

  // Members of the stages are collective.

  /** Time marching, the same on all ranks, which share the history. */
  std::unique_ptr<Stage> make_marching_stage(BoundaryContext &context);

  /** Writes the static solution. */
  std::unique_ptr<Stage> make_static_stage(BoundaryContext &context);

  /**
   * Computes histories and the sampled field in the domain, which follow from
   * the record of all steps on the boundary, some points at a time. Points are
   * distributed over ranks.
   */
  std::unique_ptr<Stage> make_domain_stage(BoundaryContext &context);

  /** Writes displacements [m] and velocities [m/s] of the sampled field. */
  void write_field(const BoundaryContext &context, SampledFieldOutput &output,
                   double time, const Eigen::VectorXd &displacement,
                   const Eigen::VectorXd &velocity);
} // namespace quoin

#endif
