// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/problems/block_report.h>
#include <quoin/problems/cost_estimate.h>

namespace quoin
{
  namespace
  {
    /** For measuring what steps cost, all stages together [s]. */
    constexpr double measuring_time = 0.5;

    /** Steps for which the cost of a stage without a known end is told. */
    constexpr double many_steps = 10000.;

    /** Iterations that a step takes at least, if joints yield. */
    constexpr double few_iterations = 3.;

    /** From @p start again after the stage's end or a failure. */
    void take_trial_step(BlockContext &context, const StageParameters &stage,
                         const State<2> &start, State<2> &state)
    {
      BlockSystem &system = context.system;
      if (stage.end == StageEnd::time
          && state.stage_step >= context.steps.n_steps())
        state = start;
      ExplicitSolver::Requests requests;
      requests.balance
          = state.stage_step % ExplicitSolver::balance_interval == 0;
      requests.energies
          = context.outputs.row_is_due(state.time,
                                       system.explicit_solver->get_time_step())
            || (requests.balance && stage.end == StageEnd::static_ratio);
      try
      {
        system.explicit_solver->step(state, requests);
      }
      catch (const RunError &)
      {
        // Of no account: the stages before, which bring the model to where this
        // one begins, have not run.
        state = start;
      }
    }

    void report_steps(BlockContext &context, const StageParameters &stage,
                      const State<2> &start)
    {
      BlockSystem &system          = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      // The state is a copy; what steps leave in the solver is lost with it,
      // since nothing runs after a check.
      State<2> state      = start;
      unsigned int period = 1;
      if (system.solver->far_field_acts())
      {
        const FarField &far = *system.solver->far_field();
        period = period_of(far.boundary_history()) * far.n_substeps();
        // The first two prepare matrices for their steps.
        for (unsigned int i = 0; i < 2; ++i)
          take_trial_step(context, stage, start, state);
      }
      const double seconds = seconds_per_call(
          [&]() { take_trial_step(context, stage, start, state); },
          measuring_time / double(parameters.stages.size()),
          system.communicator, period);
      if (stage.end != StageEnd::time)
        log.message("stage " + stage.name + ": "
                    + seconds_text(many_steps * seconds)
                    + " for each 10 000 steps, of which it takes as many as it "
                      "needs"
                    + (stage.safety ? " for each factor" : " to settle"));
      else
        log.message("stage " + stage.name + ": about "
                    + seconds_text(double(context.steps.n_steps()) * seconds)
                    + (stage.slows_loads() ? " or more" : ""));
    }

    void report_iterations(BlockContext &context, const unsigned int index,
                           const State<2> &state)
    {
      BlockSystem &system          = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      const double seconds         = seconds_per_call(
          [&]() { system.implicit_solver->try_iteration(state); },
          measuring_time / double(parameters.stages.size()),
          system.communicator);
      const double n = system.implicit_solver->least_steps();
      log.message("stage " + parameters.stages[index].name + ": "
                  + seconds_text(seconds)
                  + " for a matrix, its factors and solutions; "
                  + number_text(n) + (n == 1. ? " step" : " steps")
                  + " of some iterations or more, "
                  + seconds_text(n * few_iterations * seconds) + " or more");
    }

  } // namespace

  void report_costs(BlockContext &context)
  {
    BlockSystem &system          = context.system;
    const Parameters &parameters = system.parameters;
    Log &log                     = context.run.log;
    // Nobody would read it.
    if (context.run.options.quiet)
      return;
    State<2> state = context.state;
    std::vector<double> time_steps;
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      system.begin_stage(i, state, false);
      if (system.implicit_solver)
      {
        report_iterations(context, i, state);
        state.time += system.implicit_solver->duration();
        continue;
      }
      context.steps.choose(parameters.stages[i]);
      time_steps.push_back(system.explicit_solver->get_time_step());
      report_steps(context, parameters.stages[i], state);
    }
    system.construction->restart();
    log.message("memory: " + bytes_text(resident_memory(system.communicator))
                + " by now");

    const PlannedOutput planned = planned_output(parameters, time_steps);
    const std::string least     = planned.is_least ? " or more" : "";
    const double of_fields
        = double(planned.moments) * bytes_of_fields(*system.model);
    const double of_rows
        = double(planned.rows) * bytes_of_row(context.outputs.n_columns());
    log.message("disk: " + std::to_string(planned.moments)
                + " moments of fields" + least + ", " + bytes_text(of_fields)
                + (system.implicit_solver
                       ? ""
                       : "; " + std::to_string(planned.rows) + " rows of tables"
                             + least + ", " + bytes_text(of_rows)));
  }
} // namespace quoin
