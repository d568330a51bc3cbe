// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_problem/block_stage.h>
#include <quoin/results/result_origin.h>

namespace quoin
{
  namespace
  {
    class ImplicitStage : public BlockStage<2>
    {
    public:
      ImplicitStage(BlockContext<2> &context, const unsigned int index)
        : BlockStage<2>(context, index), solver(*system.implicit_solver)
      {
      }

      void begin() override
      {
        begin_model();
        if (state.step == 0)
          add_row();
      }
      void resume() override
      {
        system.resume_stage(index, state);
      }
      bool has_ended() const override
      {
        return is_to_end() || solver.has_ended(state);
      }
      Checkpoint take_step() override;
      ProgressFigures figures() const override
      {
        return figures_at(load_share());
      }

    private:
      /** Takes the solver's step and counts its iterations. */
      void step();
      void advance();
      void add_row();

      ImplicitSolver &solver;
    };

    Stage::Checkpoint ImplicitStage::take_step()
    {
      follow_joint_motion();
      try
      {
        advance();
      }
      catch (const RunError &error)
      {
        // The last equilibrium is written.
        outputs.write_iterations();
        fail(error.what());
      }
      return Checkpoint::possible;
    }

    void ImplicitStage::step()
    {
      const ImplicitRecord &record = solver.record();
      const auto iterations        = record.n_iterations;
      const auto cuts              = record.n_cuts;
      const auto count             = [&]()
      {
        context.iterations += record.n_iterations - iterations;
        context.cuts += record.n_cuts - cuts;
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
    }

    void ImplicitStage::advance()
    {
      const double before = state.time;
      step();
      note_failed_joints(state);
      solver.check_finite(state);
      outputs.write_iterations();
      for (const JumpReport &jump : std::exchange(solver.record().jumps, {}))
        log.message("jumped to another equilibrium at the load time ",
                    jump.load_time, " s, in ", jump.n_steps, " steps, losing ",
                    jump.loss, " J");
      // The release of forces at the start, and a jump, take no time and have a
      // row only at their end.
      const ImplicitState &now = state.get<ImplicitState>();
      if (now.released == 1. && !now.jumps)
        add_row();
      context.run.tables.check();
      if (state.time > before
          && outputs.fields_are_due(state.time, state.time - before))
        outputs.write_fields(state);
    }

    void ImplicitStage::add_row()
    {
      before_row();
      write_row();
    }
  } // namespace

  std::unique_ptr<Stage> make_implicit_stage(BlockContext<2> &context,
                                             const unsigned int index)
  {
    return std::make_unique<ImplicitStage>(context, index);
  }
} // namespace quoin
