// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_problem/block_stage.h>
#include <quoin/results/result_origin.h>

namespace quoin
{
  namespace
  {
    template <int dim>
    class ImplicitStage : public BlockStage<dim>
    {
    public:
      ImplicitStage(BlockContext<dim> &context, const unsigned int index)
        : BlockStage<dim>(context, index),
          solver(*context.system.implicit_solver)
      {
      }

      void begin() override
      {
        this->begin_model();
        if (state.step == 0)
          add_row();
      }
      void resume() override
      {
        system.resume_stage(this->index, state);
      }
      bool has_ended() const override
      {
        return this->is_to_end() || solver.has_ended(state);
      }
      Stage::Checkpoint take_step() override;
      ProgressFigures figures() const override
      {
        return this->figures_at(this->load_share());
      }

    private:
      using BlockStage<dim>::context;
      using BlockStage<dim>::log;
      using BlockStage<dim>::outputs;
      using BlockStage<dim>::state;
      using BlockStage<dim>::system;

      /** Takes the solver's step and counts its iterations. */
      void step();
      void advance();
      void add_row();

      ImplicitSolver<dim> &solver;
    };

    template <int dim>
    Stage::Checkpoint ImplicitStage<dim>::take_step()
    {
      this->follow_joint_motion();
      try
      {
        advance();
      }
      catch (const RunError &error)
      {
        // The last equilibrium is written.
        outputs.write_iterations();
        this->fail(error.what());
      }
      return Stage::Checkpoint::possible;
    }

    template <int dim>
    void ImplicitStage<dim>::step()
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

    template <int dim>
    void ImplicitStage<dim>::advance()
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
      const ImplicitState &now = state.template get<ImplicitState>();
      if (now.released == 1. && !now.jumps)
        add_row();
      context.run.tables.check();
      if (state.time > before
          && outputs.fields_are_due(state.time, state.time - before))
        outputs.write_fields(state);
    }

    template <int dim>
    void ImplicitStage<dim>::add_row()
    {
      this->before_row();
      this->write_row();
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Stage> make_implicit_stage(BlockContext<dim> &context,
                                             const unsigned int index)
  {
    return std::make_unique<ImplicitStage<dim>>(context, index);
  }

  template std::unique_ptr<Stage> make_implicit_stage(BlockContext<2> &,
                                                      unsigned int);
  template std::unique_ptr<Stage> make_implicit_stage(BlockContext<3> &,
                                                      unsigned int);
} // namespace quoin
