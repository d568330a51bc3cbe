// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/costs.h>
#include <quoin/results/field_output.h>
#include <quoin/tdbem/time_marching.h>

#include <algorithm>

namespace quoin
{
  PlannedOutput planned_output(const Parameters &parameters,
                               const std::vector<double> &time_steps)
  {
    PlannedOutput result;
    const auto count
        = [](const double n) { return std::uint64_t(std::min(n, 1e18)); };
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      // Each stage has an output at its end.
      ++result.fields;
      if (i < time_steps.size())
        ++result.rows;
      if (stage.end != StageEnd::time || stage.slows_loads())
        result.is_least = true;
      if (stage.end != StageEnd::time)
        continue;
      if (parameters.field_interval > 0.)
        result.fields
            += count(stage.duration / parameters.field_interval * (1. + 1e-9));
      if (i < time_steps.size())
        result.rows
            += count(stage.duration
                     / std::max(parameters.history_interval, time_steps[i]));
    }
    return result;
  }

  void report_memory_and_disk(const RunContext &run, const std::string &more,
                              const PlannedOutput &planned,
                              const double bytes_of_fields,
                              const std::size_t n_columns)
  {
    constexpr double bytes_of_number = 18.;
    run.log.message("memory: ", bytes_text(resident_memory(run.communicator)),
                    " by now", more);
    const char *least = planned.is_least ? " or more" : "";
    std::string rows;
    if (planned.rows > 0)
      rows = text_of("; ", planned.rows, " rows of tables", least, ", ",
                     bytes_text(double(planned.rows) * double(n_columns)
                                * bytes_of_number));
    run.log.message("disk: ", planned.fields, " output times of fields", least,
                    ", ", bytes_text(double(planned.fields) * bytes_of_fields),
                    rows);
  }

  // -- blocks ----------------------------------------------------------------

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
      if (system.solver->far_fields().elastodynamic_acts)
      {
        const FarField &far = *system.solver->far_fields().elastodynamic;
        period = far.boundary_history().period() * far.n_substeps();
        // The first two prepare matrices for their steps.
        for (unsigned int i = 0; i < 2; ++i)
          take_trial_step(context, stage, start, state);
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

    void report_iterations(BlockContext<2> &context, const unsigned int index,
                           const State<2> &state)
    {
      BlockSystem<2> &system       = context.system;
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
      if constexpr (dim == 2)
        if (system.implicit_solver)
        {
          report_iterations(context, i, state);
          state.time += system.implicit_solver->steps().duration();
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

  // -- boundary elements alone -----------------------------------------------

  namespace
  {
    /** Number of integrals over elements, one a step, for measuring a point. */
    constexpr double most_integrals = 1e5;

    /** Bytes in vtu files of each element or point at an output time. */
    constexpr double bytes_of_element = 250., bytes_of_point = 150.;

    /** Time of all steps, estimated from some; overwrites the history [s]. */
    double seconds_of_march(BoundarySystem &system)
    {
      TimeMarching trial(*system.kernel, *system.history,
                         system.given->traction_is_given());
      std::uint64_t step = 0;
      return double(system.n_steps)
             * seconds_per_call(
                 [&]()
                 {
                   const double start
                       = double(step++ % system.n_steps) * system.dt,
                       end = start + system.dt;
                   trial.step(system.scattered_values(
                       start, end, system.waves->displacements(end),
                       system.waves->tractions(start, end)));
                 },
                 measuring_time, system.communicator, system.history->period());
    }

    /** Time of the points in the domain, estimated from some [s]. */
    double seconds_of_points(const BoundarySystem &system,
                             const StepControl &control)
    {
      const double n_elements = system.geometry.boundary.n_elements();
      // All steps, or as many as are measured quickly.
      const auto n = static_cast<unsigned int>(
          std::clamp(most_integrals / n_elements, 1., double(system.n_steps)));
      const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(
          n, Eigen::Index(system.geometry.boundary.n_unknowns()));
      const BoundaryRecord record{ system.dt, system.settings.decay, zero,
                                   zero };
      const double share = double(system.n_steps) / n;
      // Points far from the boundary, where waves arrive late, cost less: a
      // sample of points is taken.
      const auto seconds = [&](const std::vector<Eigen::Vector2d> &points,
                               const std::vector<unsigned int> &steps)
      {
        constexpr std::size_t n_tried = 3;
        const auto try_some           = [&]()
        {
          for (std::size_t i = 0; i < n_tried; ++i)
            system.domain_displacements(
                record, { points[(2 * i + 1) * points.size() / (2 * n_tried)] },
                steps);
        };
        return seconds_per_call(try_some, 0.1 * measuring_time,
                                system.communicator)
               * share / n_tried * double(points.size());
      };
      const auto due = [&](const auto &is_due)
      {
        std::vector<unsigned int> steps(1, n);
        for (unsigned int step = 1; step < n; ++step)
          if (is_due(step)) // the one before is for the velocity
            steps.insert(steps.end(), { step - 1, step });
        return steps;
      };
      double result = 0.;
      if (!system.histories->interior_points().empty())
        result += seconds(system.histories->interior_points(),
                          due(control.row_is_due));
      if (!system.sampled.points.empty())
        result += seconds(system.sampled.points, due(control.fields_are_due));
      return result
             / double(
                 dealii::Utilities::MPI::n_mpi_processes(system.communicator));
    }
  } // namespace

  void report_boundary_costs(BoundarySystem &system, const StepControl &control,
                             const RunContext &run)
  {
    std::string of_points;
    if (system.needs_record())
      of_points = text_of(
          ", and ", seconds_text(seconds_of_points(system, control)), " for ",
          system.points_in_domain().size(), " points in the domain");
    run.log.message("time: about ", seconds_text(seconds_of_march(system)),
                    system.settings.direct_history ? " or more" : "", " for ",
                    system.n_steps, " steps", of_points);
    PlannedOutput planned;
    for (std::uint64_t step = 0; step <= system.n_steps; ++step)
    {
      planned.fields += control.fields_are_due(step) ? 1 : 0;
      planned.rows += control.row_is_due(step) ? 1 : 0;
    }
    report_memory_and_disk(
        run, system.needs_record() ? ", and the record of the boundary" : "",
        planned,
        bytes_of_element * double(system.geometry.boundary.n_elements())
            + bytes_of_point * double(system.sampled.points.size()),
        system.histories->column_names().size());
  }
} // namespace quoin
