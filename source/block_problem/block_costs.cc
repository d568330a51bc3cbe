// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/wall_clock.h>
#include <quoin/block_problem/block_costs.h>
#include <quoin/problems/planned_output.h>
#include <quoin/results/field_output.h>
#include <quoin/results/measurements.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Time for measuring the steps of all stages [s]. */
    constexpr double measuring_time = 0.5;

    /** Steps for which the cost of a stage of unknown length is reported. */
    constexpr double many_steps = 10000.;

    /** Least number of iterations of a step, if joints yield. */
    constexpr double few_iterations = 3.;

    /** Takes a step, again from @p start after the end or a failure. */
    template <int dim>
    void take_trial_step(BlockContext<dim> &context,
                         const StageParameters &stage, const State<dim> &start,
                         State<dim> &state)
    {
      BlockSystem<dim> &system = context.system;
      if (stage.end == StageEnd::time
          && state.stage_step >= context.steps.n_steps())
        state = start;
      typename ExplicitSolver<dim>::Requests requests;
      requests.balance
          = state.stage_step % ExplicitSolver<dim>::balance_interval == 0;
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
        // Failures do not count: the previous stages, which lead to the start
        // of this one, have not run.
        state = start;
      }
    }

    template <int dim>
    void report_steps(BlockContext<dim> &context, const StageParameters &stage,
                      const State<dim> &start)
    {
      BlockSystem<dim> &system     = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      // The state is a copy; changes of the solver do no harm, as nothing runs
      // after a check.
      State<dim> state    = start;
      unsigned int period = 1;
      if (system.solver->loads().far.elastodynamic_acts)
      {
        const FarField &far = *system.solver->loads().far.elastodynamic;
        period = far.boundary_history().period() * far.n_substeps();
        // The first two prepare matrices for their steps.
        const auto begin = WallClock::now();
        for (unsigned int i = 0; i < 2; ++i)
          take_trial_step(context, stage, start, state);
        log.message(
            "stage ", stage.name, ": ", seconds_text(seconds_since(begin)),
            " for what the first steps of the boundary elements prepare");
      }
      const double seconds = seconds_per_call(
          [&]() { take_trial_step(context, stage, start, state); },
          measuring_time / double(parameters.stages.size()),
          system.communicator, period);
      if (stage.safety)
      {
        // Strengths fall in the quiet time, and as long again settles them.
        const double n_steps
            = std::ceil(2. * system.explicit_solver->quiet_time()
                        / system.explicit_solver->get_time_step());
        const unsigned int n_trials = stage.safety->least_trials();
        log.message("stage ", stage.name, ": ", n_trials,
                    " factors or more, each of ", n_steps, " steps or more: ",
                    seconds_text(n_trials * n_steps * seconds), " or more");
      }
      else if (stage.end != StageEnd::time)
        log.message("stage ", stage.name, ": ",
                    seconds_text(many_steps * seconds),
                    " for each 10 000 steps, of which it takes as many as "
                    "equilibrium needs");
      else
        log.message("stage ", stage.name, ": about ",
                    seconds_text(double(context.steps.n_steps()) * seconds),
                    stage.slows_loads() ? " or more" : "");
    }

    template <int dim>
    void report_iterations(BlockContext<dim> &context, const unsigned int index,
                           const State<dim> &state)
    {
      BlockSystem<dim> &system     = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      const double seconds         = seconds_per_call(
          [&]() { system.implicit_solver->try_iteration(state); },
          measuring_time / double(parameters.stages.size()),
          system.communicator);
      const double n = system.implicit_solver->steps().least_steps();
      log.message("stage ", parameters.stages[index].name, ": ",
                  seconds_text(seconds),
                  " for a matrix, its factors and solutions; ", n,
                  n == 1. ? " step" : " steps", " of some iterations or more, ",
                  seconds_text(n * few_iterations * seconds), " or more");
    }
  } // namespace

  template <int dim>
  void report_block_costs(BlockContext<dim> &context)
  {
    BlockSystem<dim> &system     = context.system;
    const Parameters &parameters = system.parameters;
    State<dim> state             = context.state;
    std::vector<double> time_steps;
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      system.begin_stage(i, state, false);
      if (system.implicit_solver)
      {
        report_iterations(context, i, state);
        state.load_time = system.implicit_solver->steps().duration();
        state.time += state.load_time;
        continue;
      }
      context.steps.choose(parameters.stages[i]);
      time_steps.push_back(system.explicit_solver->get_time_step());
      report_steps(context, parameters.stages[i], state);
    }
    if (system.construction)
      system.construction->restart();
    report_memory_and_disk(
        context.run, "", planned_output(parameters, time_steps),
        bytes_of_fields(*system.model), context.outputs.n_columns());
  }

  template void report_block_costs(BlockContext<2> &);
  template void report_block_costs(BlockContext<3> &);
} // namespace quoin
