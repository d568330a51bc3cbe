// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What Simulation does with the implicit solver.

#include <quoin/problems/model_summary.h>
#include <quoin/problems/simulation.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>

namespace quoin
{
  void Simulation::report_implicit_model()
  {
    // Stages are begun with a copy, to find what is wrong with them.
    State<2> state = record.state;
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      begin_stage(i, state);
      if (options.check)
        log.message(stage_line(parameters.stages[i], true));
      log.message("stage " + parameters.stages[i].name
                  + ": equilibrium up to the load time "
                  + number_text(implicit_solver->duration()) + " s, "
                  + std::to_string(implicit_solver->n_unknowns())
                  + " unknowns, "
                  + (implicit_solver->is_direct() ? "LU factors"
                                                  : "GMRES with multigrid"));
      state.time += implicit_solver->duration();
    }
    construction->restart();
    log.message("inertia, damping and mass scaling are left out");
  }

  void Simulation::run_implicit_stage(const unsigned int index)
  {
    const StageParameters &stage = parameters.stages[index];
    State<2> &state              = record.state;
    if (record.stage_begun)
      implicit_solver->resume_stage(stage, state);
    else
    {
      begin_stage(index, state);
      record.stage_begun = true;
    }

    if (state.step == 0)
      write_implicit_rows();
    progress.start(progress_figures(stage));
    while (!implicit_solver->is_over(state))
    {
      try
      {
        take_implicit_step();
      }
      catch (const RunError &error)
      {
        // The last equilibrium is worth looking at.
        write_iterations();
        write_fields();
        write_summary(false);
        save_checkpoint();
        throw RunError("stage '" + stage.name + "': " + error.what());
      }
      if (progress.due())
        progress.update(progress_figures(stage));
      checkpoint_if_due();
    }
    progress.finish(progress_figures(stage));
    end_stage(index);
  }

  void Simulation::take_implicit_step()
  {
    State<2> &state       = record.state;
    const double before   = state.time;
    const auto iterations = implicit_solver->n_iterations();
    const auto cuts       = implicit_solver->n_cuts();
    const auto start      = WallClock::now();
    const auto count      = [&]()
    {
      const double seconds = seconds_since(start);
      record.wall_time += seconds;
      seconds_done += seconds;
      record.iterations += implicit_solver->n_iterations() - iterations;
      record.cuts += implicit_solver->n_cuts() - cuts;
    };
    try
    {
      implicit_solver->step(state);
    }
    catch (const RunError &)
    {
      count();
      throw;
    }
    count();
    ++steps_done;
    solver->check_finite(state);
    write_iterations();
    for (const JumpReport &jump : implicit_solver->take_jumps())
      log.message("jumped to another equilibrium at the load time "
                  + number_text(jump.load_time) + " s, in "
                  + std::to_string(jump.n_steps) + " steps, losing "
                  + number_text(jump.loss) + " J");
    // What is let go at the start, and a jump, take no time: only where they
    // end there is a row.
    if (state.implicit.released == 1. && !state.implicit.jumps)
      write_implicit_rows();
    check_tables();
    if (state.time > before
        && field_control.is_due(state.time, state.time - before))
      write_fields();
  }

  void Simulation::write_implicit_rows()
  {
    histories->before_step(record.state);
    const auto row = histories->after_step(record.state);
    write_energies(row.front());
    record.history_table.add_row(row);
  }

  void Simulation::write_iterations()
  {
    for (const IterationReport &report : implicit_solver->take_reports())
      record.convergence_table.add_row(
          { double(report.step), double(report.attempt),
            double(report.iteration), report.load_time, report.unbalanced_ratio,
            report.line_search, report.linear_iterations });
  }
} // namespace quoin
