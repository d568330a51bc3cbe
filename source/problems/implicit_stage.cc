// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/problems/implicit_stage.h>

namespace quoin
{
  ImplicitStage::ImplicitStage(BlockContext &context, const unsigned int index)
    : context(context), index(index),
      stage(context.system.parameters.stages[index]), state(context.state),
      solver(*context.system.implicit_solver)
  {
  }

  void ImplicitStage::begin()
  {
    context.system.begin_stage(index, state);
    if (state.step == 0)
      write_row();
  }

  void ImplicitStage::resume()
  {
    context.system.resume_stage(index, state);
  }

  Problem::Checkpoint ImplicitStage::take_step()
  {
    try
    {
      advance();
    }
    catch (const RunError &error)
    {
      // The last equilibrium is worth looking at.
      context.outputs.write_iterations();
      context.outputs.write_fields(state);
      throw FailedStep("stage '" + stage.name + "': " + error.what());
    }
    return Problem::Checkpoint::possible;
  }

  void ImplicitStage::advance()
  {
    const double before   = state.time;
    const auto iterations = solver.n_iterations();
    const auto cuts       = solver.n_cuts();
    const auto count      = [&]()
    {
      context.iterations += solver.n_iterations() - iterations;
      context.cuts += solver.n_cuts() - cuts;
    };
    try
    {
      solver.step(state);
    }
    catch (const RunError &)
    {
      count();
      throw;
    }
    count();
    ++context.n_done;
    solver.check_finite(state);
    context.outputs.write_iterations();
    for (const JumpReport &jump : solver.take_jumps())
      context.run.log.message("jumped to another equilibrium at the load time "
                              + number_text(jump.load_time) + " s, in "
                              + std::to_string(jump.n_steps) + " steps, losing "
                              + number_text(jump.loss) + " J");
    // What is let go at the start, and a jump, take no time: only where they
    // end there is a row.
    const ImplicitState &now = state.get<ImplicitState>();
    if (now.released == 1. && !now.jumps)
      write_row();
    context.outputs.check_tables();
    if (state.time > before
        && context.outputs.fields_are_due(state.time, state.time - before))
      context.outputs.write_fields(state);
  }

  void ImplicitStage::write_row()
  {
    context.outputs.before_row(state);
    context.outputs.write_row(state);
  }

  ProgressFigures ImplicitStage::figures() const
  {
    return context.progress_figures(stage, load_share(context));
  }

  double load_share(const BlockContext &context)
  {
    return context.state.get<ImplicitState>().released < 1.
               ? 0.
               : context.state.load_time
                     / context.system.implicit_solver->duration();
  }
} // namespace quoin
