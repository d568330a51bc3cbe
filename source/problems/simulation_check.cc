// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What Simulation says with --check beyond sizes and time steps, and what it
// warns of in any run.

#include <quoin/problems/cost_estimate.h>
#include <quoin/problems/input_advice.h>
#include <quoin/problems/model_summary.h>
#include <quoin/problems/shaking.h>
#include <quoin/problems/simulation.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>

#include <cmath>

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

    /** Of the stages that end by time [s]. */
    double total_duration(const std::vector<StageParameters> &stages)
    {
      return start_of_stage(stages, stages.size());
    }
  } // namespace

  void Simulation::report_parts()
  {
    for (const auto &lines :
         { material_lines(parameters, mesh,
                          model->properties().material_of_group),
           joint_lines(parameters, mesh_report), load_lines(parameters, mesh),
           boundary_lines(parameters.boundary, boundary_geometry,
                          total_duration(parameters.stages)) })
      for (const std::string &line : lines)
        log.message(line);
  }

  void Simulation::advise(const std::vector<std::string> &advice)
  {
    for (const std::string &text : advice)
      log.warning(text);
  }

  void Simulation::advise_about_stage(const unsigned int index,
                                      const State<2> &state)
  {
    const StageParameters &stage = parameters.stages[index];
    if (stage.end == StageEnd::time && !model->large_displacements())
      advise(free_body_advice(stage.name, solver->pushed_bodies(state)));
    advise(stage_advice(parameters, index, *model, state,
                        explicit_solver->get_time_step()));
    if (!solver->far_field_acts())
      return;
    const FarFieldDomain &domain = solver->far_field()->domain();
    advise(element_advice(
        fastest_boundary_value(parameters.boundary, boundary_geometry,
                               stage.duration),
        domain.medium.c2, domain.boundary.lengths().maxCoeff()));
  }

  void Simulation::report_costs()
  {
    // Nobody would read it.
    if (options.quiet)
      return;
    State<2> state = record.state;
    std::vector<double> time_steps;
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      begin_stage(i, state, false);
      if (implicit_solver)
      {
        report_iterations(i, state);
        state.time += implicit_solver->duration();
        continue;
      }
      choose_time_step(parameters.stages[i]);
      time_steps.push_back(explicit_solver->get_time_step());
      report_steps(parameters.stages[i], state);
    }
    construction->restart();
    log.message("memory: " + bytes_text(resident_memory(communicator))
                + " by now");

    const PlannedOutput planned = planned_output(parameters, time_steps);
    const std::string least     = planned.is_least ? " or more" : "";
    const double of_fields = double(planned.moments) * bytes_of_fields(*model);
    constexpr std::size_t n_energies = 15;
    const double of_rows
        = double(planned.rows)
          * bytes_of_row(n_energies + histories->column_names().size());
    log.message("disk: " + std::to_string(planned.moments)
                + " moments of fields" + least + ", " + bytes_text(of_fields)
                + (implicit_solver
                       ? ""
                       : "; " + std::to_string(planned.rows) + " rows of tables"
                             + least + ", " + bytes_text(of_rows)));
  }

  void Simulation::take_trial_step(const StageParameters &stage,
                                   const State<2> &start, State<2> &state)
  {
    if (stage.end == StageEnd::time && state.stage_step >= steps_of_stage)
      state = start;
    ExplicitSolver::Requests requests;
    requests.balance = state.stage_step % ExplicitSolver::balance_interval == 0;
    requests.energies
        = history_control.is_due(state.time, explicit_solver->get_time_step())
          || (requests.balance && stage.end == StageEnd::static_ratio);
    try
    {
      explicit_solver->step(state, requests);
    }
    catch (const RunError &)
    {
      // Of no account: the stages before, which bring the model to where this
      // one begins, have not run.
      state = start;
    }
  }

  void Simulation::report_steps(const StageParameters &stage,
                                const State<2> &start)
  {
    // The state is a copy; what steps leave in the solver is lost with it,
    // since nothing runs after a check.
    State<2> state      = start;
    unsigned int period = 1;
    if (solver->far_field_acts())
    {
      const FarField &far = *solver->far_field();
      period = period_of(far.boundary_history()) * far.n_substeps();
      // The first two prepare matrices for their steps.
      for (unsigned int i = 0; i < 2; ++i)
        take_trial_step(stage, start, state);
    }
    const double seconds
        = seconds_per_call([&]() { take_trial_step(stage, start, state); },
                           measuring_time / double(parameters.stages.size()),
                           communicator, period);
    if (stage.end != StageEnd::time)
      log.message("stage " + stage.name + ": "
                  + seconds_text(many_steps * seconds)
                  + " for each 10 000 steps, of which it takes as many as it "
                    "needs"
                  + (stage.safety ? " for each factor" : " to settle"));
    else
      log.message("stage " + stage.name + ": about "
                  + seconds_text(double(steps_of_stage) * seconds)
                  + (stage.slows_loads() ? " or more" : ""));
  }

  void Simulation::report_iterations(const unsigned int index,
                                     const State<2> &state)
  {
    const double seconds = seconds_per_call(
        [&]() { implicit_solver->try_iteration(state); },
        measuring_time / double(parameters.stages.size()), communicator);
    const double n = implicit_solver->least_steps();
    log.message(
        "stage " + parameters.stages[index].name + ": " + seconds_text(seconds)
        + " for a matrix, its factors and solutions; " + number_text(n)
        + (n == 1. ? " step" : " steps") + " of some iterations or more, "
        + seconds_text(n * few_iterations * seconds) + " or more");
  }
} // namespace quoin
