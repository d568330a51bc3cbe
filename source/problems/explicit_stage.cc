// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/problems/explicit_stage.h>
#include <quoin/results/checkpoint_clock.h>

namespace quoin
{
  ExplicitStage::ExplicitStage(BlockContext &context, const unsigned int index)
    : context(context), index(index),
      stage(context.system.parameters.stages[index]), state(context.state),
      solver(*context.system.explicit_solver)
  {
  }

  void ExplicitStage::begin()
  {
    context.system.begin_stage(index, state);
    prepare();
  }

  void ExplicitStage::resume()
  {
    context.system.resume_stage(index, state);
    prepare();
  }

  void ExplicitStage::prepare()
  {
    context.steps.choose(stage);
    solver.discard_saved(state);
    over = stage.end == StageEnd::time && time_is_over();
  }

  Problem::Checkpoint ExplicitStage::take_step()
  {
    const double dt = solver.get_time_step();
    const bool balance
        = state.stage_step % ExplicitSolver::balance_interval == 0;
    if (context.outputs.fields_are_due(state.time, dt))
      context.outputs.write_fields(state);

    const bool row_is_due = context.outputs.row_is_due(state.time, dt);
    ExplicitSolver::Requests requests;
    requests.energies = row_is_due || may_be_last(balance);
    requests.balance
        = balance || (row_is_due && context.outputs.row_needs_balance());
    if (requests.energies)
      context.outputs.before_row(state);
    try
    {
      solver.step(state, requests);
    }
    catch (const RunError &error)
    {
      throw RunError("stage '" + stage.name + "': " + error.what());
    }
    ++context.n_done;
    report_blocks_outside();
    over = ends_here(balance);
    if (row_is_due || over)
    {
      solver.check_finite(state);
      context.outputs.write_row(state);
    }
    if (balance || over)
      context.outputs.check_tables();
    return state.stage_step % CheckpointClock::steps_between_looks == 0
               ? Problem::Checkpoint::possible
               : Problem::Checkpoint::no;
  }

  bool ExplicitStage::may_be_last(const bool balance) const
  {
    if (stage.slows_loads())
      return loads_are_over(state.load_time
                            + (1. + 1e-6) * state.load_rate
                                  * solver.get_time_step());
    // A static stage may find only afterwards that this was its last step.
    return stage.end == StageEnd::time
               ? state.stage_step + 1 == context.steps.n_steps()
               : balance;
  }

  bool ExplicitStage::loads_are_over(const double load_time) const
  {
    return load_time >= (1. - 1e-12) * stage.duration;
  }

  bool ExplicitStage::time_is_over() const
  {
    return stage.slows_loads() ? loads_are_over(state.load_time)
                               : state.stage_step >= context.steps.n_steps();
  }

  bool ExplicitStage::ends_here(const bool balance) const
  {
    if (stage.end == StageEnd::time)
    {
      if (time_is_over())
        return true;
      if (stage.slows_loads() && state.stage_step >= stage.maximum_steps)
        throw RunError(
            "stage '" + stage.name + "' has not come to its end within "
            + std::to_string(stage.maximum_steps) + " steps: its loads are at "
            + number_text(state.load_time) + " of "
            + number_text(stage.duration) + " s and go on at the rate "
            + number_text(state.load_rate)
            + ". Raise 'Kinetic energy limit' or 'Maximum steps', or damp "
              "more.");
      return false;
    }
    if (balance && has_settled(context, stage))
      return true;
    if (state.stage_step >= stage.maximum_steps)
      throw RunError("stage '" + stage.name + "' has not settled within "
                     + std::to_string(stage.maximum_steps)
                     + " steps: the unbalanced ratio is "
                     + number_text(state.unbalanced_ratio) + " instead of "
                     + number_text(stage.static_ratio)
                     + ". The model may have no equilibrium under these "
                       "loads; otherwise raise 'Maximum steps' or damp more.");
    return false;
  }

  void ExplicitStage::report_blocks_outside()
  {
    const bool removes = context.system.parameters.model.contact.outside
                         == ContactParameters::Outside::remove;
    for (const BlockOutside &block : solver.take_blocks_outside())
      context.run.log.warning(
          "block " + std::to_string(block.block) + ", at ("
          + number_text(block.position[0]) + ", "
          + number_text(block.position[1]) + ") m, has left the box at time "
          + number_text(block.time) + " s"
          + (block.removed ? " and is deleted"
             : removes     ? "; it stays in the model, because a load moves it "
                             "or joints tie it to a block that stays"
                           : ""));
  }

  ProgressFigures ExplicitStage::figures() const
  {
    return context.progress_figures(
        stage,
        stage.end == StageEnd::time ? state.load_time / stage.duration : -1.);
  }
} // namespace quoin
