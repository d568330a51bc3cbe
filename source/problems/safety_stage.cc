// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/block_stage.h>
#include <quoin/results/atomic_file.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Automatic failure displacement, by the model's diagonal. */
    constexpr double failure_share = 1e-3;

    class SafetyStage : public BlockStage<2>
    {
    public:
      SafetyStage(BlockContext<2> &context, const unsigned int index)
        : BlockStage<2>(context, index), safety(*stage.safety),
          search(context.searches[index]), base(state),
          strong(system.model->properties())
      {
      }

      void begin() override
      {
      }
      void resume() override
      {
        system.restore(index, state);
        strong = system.model->properties();
      }
      bool has_ended() const override
      {
        return search.has_ended(safety);
      }
      Checkpoint take_step() override;
      ProgressFigures figures() const override
      {
        return figures_at(system.implicit_solver ? load_share() : -1.);
      }

    private:
      void finish() override;
      /** Sets the strengths of the start of the stage, divided by @p factor. */
      void set_strength(double factor);
      SafetyTrial try_factor(double factor);
      void come_to_rest(SafetyTrial &trial);
      void find_equilibrium(SafetyTrial &trial);
      /** Largest one since the start of the stage [m]; collective. */
      double largest_displacement() const;

      const SafetyParameters &safety;
      FactorSearch &search;
      const State<2> base;
      ModelProperties strong;
    };

    Stage::Checkpoint SafetyStage::take_step()
    {
      system.begin_stage(index, state);
      set_strength(search.next(safety));
      const SafetyTrial trial = try_factor(search.next(safety));
      log.message("stage ", stage.name, ": factor ", trial.factor, " is ",
                  trial.is_stable    ? "stable"
                  : trial.is_decided ? "failing"
                                     : "undecided and counts as failing",
                  " after ", trial.n_steps, " steps, largest displacement ",
                  trial.displacement, " m");
      if (!trial.is_stable && trial.factor < search.lowest_failing())
        outputs.write_mechanism(state, base, trial.factor);
      search.add(trial);
      state = base;
      system.set_properties(strong, state);
      context.run.on_first_rank(
          [&]()
          { write_text(context.run.output + "/safety.csv", search.table()); });
      return Checkpoint::wanted;
    }

    void SafetyStage::set_strength(const double factor)
    {
      ModelProperties weak = strong;
      if (safety.reduces_joints)
        for (JointSetParameters &set : weak.joints)
          set.law = reduced(set.law, factor);
      if (safety.reduces_blocks)
        for (MaterialParameters &material : weak.materials)
          material = reduced(material, factor);
      system.set_properties(weak, state);
    }

    SafetyTrial SafetyStage::try_factor(const double factor)
    {
      SafetyTrial trial;
      trial.factor = factor;
      context.run.progress.start(figures());
      if (system.implicit_solver)
        find_equilibrium(trial);
      else
        try
        {
          come_to_rest(trial);
        }
        catch (const ModelFailure &error)
        {
          log.message("stage ", stage.name, ": factor ", factor, ": ",
                      error.what());
        }
        catch (const RunError &error)
        {
          throw RunError("stage '" + stage.name + "': " + error.what());
        }
      context.run.progress.finish(figures());
      trial.n_steps          = state.stage_step;
      trial.unbalanced_ratio = state.unbalanced_ratio;
      trial.displacement     = largest_displacement();
      context.n_done += trial.n_steps;
      return trial;
    }

    void SafetyStage::come_to_rest(SafetyTrial &trial)
    {
      ExplicitSolver<2> &solver = *system.explicit_solver;
      FailureWatch watch(safety.failure_displacement > 0.
                             ? safety.failure_displacement
                             : failure_share
                                   * system.nodes->table().diagonal());
      context.steps.choose(stage);
      for (;;)
      {
        ExplicitSolver<2>::Requests requests;
        requests.balance
            = state.stage_step % ExplicitSolver<2>::balance_interval == 0;
        solver.step(state, requests);
        if (!requests.balance)
          continue;
        solver.check_finite(state);
        // A block that leaves the box is unstable, even if the rest is not. It
        // is back at the start of the next trial: no warning.
        if (!solver.take_blocks_outside().empty())
          return;
        trial.is_stable = has_settled();
        if (trial.is_stable || watch.has_failed(largest_displacement()))
          return;
        trial.is_decided = state.stage_step < stage.maximum_steps;
        if (!trial.is_decided)
          return;
        if (context.run.progress.due())
          context.run.progress.update(figures());
      }
    }

    void SafetyStage::find_equilibrium(SafetyTrial &trial)
    {
      ImplicitSolver &solver = *system.implicit_solver;
      try
      {
        while (!solver.has_ended(state))
        {
          solver.step(state);
          outputs.write_iterations();
          solver.record().jumps.clear();
          if (context.run.progress.due())
            context.run.progress.update(figures());
        }
        trial.is_stable = true;
      }
      catch (const ModelFailure &)
      {
        outputs.write_iterations();
        solver.record().jumps.clear();
      }
    }

    double SafetyStage::largest_displacement() const
    {
      double largest = 0.;
      for (unsigned int i = 0; i < system.model->nodes().n_owned(); ++i)
      {
        const double *now = state.nodes[i].u, *then = base.nodes[i].u;
        largest
            = std::max(largest, std::hypot(now[0] - then[0], now[1] - then[1]));
      }
      return dealii::Utilities::MPI::max(largest, context.run.communicator);
    }

    void SafetyStage::finish()
    {
      const double stable     = search.highest_stable();
      const double failing    = search.lowest_failing();
      const std::string begin = "stage " + stage.name + ": ";
      if (stable == 0.)
        log.warning(begin, "even the lowest factor, ", failing,
                    ", fails: the model has no equilibrium under these loads");
      else if (std::isinf(failing))
        log.warning(begin, "even the highest factor, ", stable,
                    ", is stable: the model may have no mechanism");
      else
        log.message(begin, "factor of safety ", 0.5 * (stable + failing),
                    ", stable at ", stable, ", failing at ", failing);
      if (system.explicit_solver)
        system.explicit_solver->restore_masses(
            *previous_stage(system.parameters.stages, index), state);
    }
  } // namespace

  std::unique_ptr<Stage> make_safety_stage(BlockContext<2> &context,
                                           const unsigned int index)
  {
    return std::make_unique<SafetyStage>(context, index);
  }
} // namespace quoin
