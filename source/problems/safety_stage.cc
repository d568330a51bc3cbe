// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/problems/implicit_stage.h>
#include <quoin/problems/safety_stage.h>
#include <quoin/results/atomic_file.h>
#include <quoin/results/collective.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Displacement that may be a failure, by the model's diagonal. */
    constexpr double failure_share = 1e-3;

    std::string safety_table(const FactorSearch &search)
    {
      std::ostringstream text;
      text.precision(12);
      text << "factor [-],stable,decided,steps,unbalanced ratio [-],largest "
              "displacement [m]\n";
      for (const SafetyTrial &trial : search.trials())
        text << trial.factor << "," << trial.is_stable << ","
             << trial.is_decided << "," << trial.n_steps << ","
             << trial.unbalanced_ratio << "," << trial.displacement << "\n";
      return text.str();
    }
  } // namespace

  SafetyStage::SafetyStage(BlockContext &context, const unsigned int index,
                           FactorSearch &search)
    : context(context), index(index),
      stage(context.system.parameters.stages[index]), safety(*stage.safety),
      search(search), state(context.state), base(state),
      strong(context.system.model->properties())
  {
  }

  void SafetyStage::resume()
  {
    context.system.restore(index, state);
    strong = context.system.model->properties();
  }

  Problem::Checkpoint SafetyStage::take_step()
  {
    context.system.begin_stage(index, state);
    set_strength(search.next(safety));
    const SafetyTrial trial = try_factor(search.next(safety));
    context.run.log.message(
        "stage " + stage.name + ": factor " + number_text(trial.factor) + " is "
        + (trial.is_stable    ? "stable"
           : trial.is_decided ? "failing"
                              : "undecided and counts as failing")
        + " after " + std::to_string(trial.n_steps)
        + " steps, largest displacement " + number_text(trial.displacement)
        + " m");
    if (!trial.is_stable && trial.factor < search.lowest_failing())
      context.outputs.write_mechanism(state, base, trial.factor);
    search.add(trial);
    state = base;
    context.system.set_properties(strong, state);
    write_table();
    return Problem::Checkpoint::wanted;
  }

  void SafetyStage::write_table() const
  {
    all_or_none<RunError>(context.run.communicator,
                          [&]()
                          {
                            if (context.run.is_first_rank())
                              write_text(context.run.output + "/safety.csv",
                                         safety_table(search));
                          });
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
    context.system.set_properties(weak, state);
  }

  SafetyTrial SafetyStage::try_factor(const double factor)
  {
    SafetyTrial trial;
    trial.factor = factor;
    context.run.progress.start(figures());
    if (context.system.implicit_solver)
      find_equilibrium(trial);
    else
      try
      {
        come_to_rest(trial);
      }
      catch (const ModelFailure &error)
      {
        context.run.log.message("stage " + stage.name + ": factor "
                                + number_text(factor) + ": " + error.what());
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
    ExplicitSolver &solver = *context.system.explicit_solver;
    FailureWatch watch(safety.failure_displacement > 0.
                           ? safety.failure_displacement
                           : failure_share * context.system.nodes->diagonal());
    context.steps.choose(stage);
    for (;;)
    {
      ExplicitSolver::Requests requests;
      requests.balance
          = state.stage_step % ExplicitSolver::balance_interval == 0;
      solver.step(state, requests);
      if (!requests.balance)
        continue;
      solver.check_finite(state);
      // What leaves the box has no equilibrium in it, even if the rest has. It
      // is back where the next trial begins: no warning.
      if (!solver.take_blocks_outside().empty())
        return;
      trial.is_stable = has_settled(context, stage);
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
    ImplicitSolver &solver = *context.system.implicit_solver;
    try
    {
      while (!solver.is_over(state))
      {
        solver.step(state);
        context.outputs.write_iterations();
        solver.take_jumps();
        if (context.run.progress.due())
          context.run.progress.update(figures());
      }
      trial.is_stable = true;
    }
    catch (const ModelFailure &)
    {
      context.outputs.write_iterations();
      solver.take_jumps();
    }
  }

  double SafetyStage::largest_displacement() const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < context.system.model->exchange().n_owned();
         ++i)
    {
      const double *now = state.nodes[i].u, *then = base.nodes[i].u;
      largest
          = std::max(largest, std::hypot(now[0] - then[0], now[1] - then[1]));
    }
    return dealii::Utilities::MPI::max(largest, context.run.communicator);
  }

  ProgressFigures SafetyStage::figures() const
  {
    return context.progress_figures(
        stage, context.system.implicit_solver ? load_share(context) : -1.);
  }

  void SafetyStage::end()
  {
    Log &log                = context.run.log;
    const double stable     = search.highest_stable();
    const double failing    = search.lowest_failing();
    const std::string begin = "stage " + stage.name + ": ";
    if (stable == 0.)
      log.warning(begin + "even the lowest factor, " + number_text(failing)
                  + ", fails: the model has no equilibrium under these loads");
    else if (std::isinf(failing))
      log.warning(begin + "even the highest factor, " + number_text(stable)
                  + ", is stable: the model may have no mechanism");
    else
      log.message(begin + "factor of safety "
                  + number_text(0.5 * (stable + failing)) + ", stable at "
                  + number_text(stable) + ", failing at "
                  + number_text(failing));
    if (context.system.explicit_solver)
      context.system.explicit_solver->restore_masses(
          *previous_stage(context.system.parameters.stages, index), state);
  }
} // namespace quoin
