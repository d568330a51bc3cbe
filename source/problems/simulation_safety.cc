// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// How Simulation finds a factor of safety.

#include <quoin/results/field_output.h>
#include <quoin/problems/simulation.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/mesh/mesh_size.h>
#include <quoin/results/atomic_file.h>
#include <quoin/results/collective.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Of the model's diagonal. */
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

  void Simulation::run_safety_stage(const unsigned int index)
  {
    const StageParameters &stage   = parameters.stages[index];
    const SafetyParameters &safety = *stage.safety;
    record.searches.resize(parameters.stages.size());
    FactorSearch &search = record.searches[index];

    // Every trial begins with the state that the stage found, and so does the
    // stage after it.
    const State<2> base          = record.state;
    const ModelProperties strong = model->properties();
    while (!search.is_over(safety))
    {
      begin_stage(index, record.state);
      set_strength(strong, safety, search.next(safety));
      const SafetyTrial trial = try_factor(stage, search.next(safety), base);
      log.message("stage " + stage.name + ": factor "
                  + number_text(trial.factor) + " is "
                  + (trial.is_stable    ? "stable"
                     : trial.is_decided ? "failing"
                                        : "undecided and counts as failing")
                  + " after " + std::to_string(trial.n_steps)
                  + " steps, largest displacement "
                  + number_text(trial.displacement) + " m");
      if (!trial.is_stable && trial.factor < search.lowest_failing())
        write_mechanism(base, trial.factor);
      search.add(trial);
      record.state = base;
      set_properties(strong);
      all_or_none<RunError>(communicator,
                            [&]()
                            {
                              if (is_first_rank)
                                write_text(output + "/safety.csv",
                                           safety_table(search));
                            });
      save_checkpoint();
    }
    report_safety(index);
    if (explicit_solver)
      explicit_solver->restore_masses(*previous_stage(parameters.stages, index),
                                      record.state);
    end_stage(index);
  }

  void Simulation::set_strength(const ModelProperties &strong,
                                const SafetyParameters &safety,
                                const double factor)
  {
    ModelProperties weak = strong;
    if (safety.reduces_joints)
      for (JointSetParameters &set : weak.joints)
        set.law = reduced(set.law, factor);
    if (safety.reduces_blocks)
      for (MaterialParameters &material : weak.materials)
        material = reduced(material, factor);
    set_properties(weak);
  }

  void Simulation::set_properties(const ModelProperties &properties)
  {
    model->set_properties(properties, record.state.construction);
    if (explicit_solver)
      explicit_solver->set_contact_laws(properties.joints);
  }

  SafetyTrial Simulation::try_factor(const StageParameters &stage,
                                     const double factor, const State<2> &base)
  {
    SafetyTrial trial;
    trial.factor     = factor;
    const auto start = WallClock::now();
    progress.start(progress_figures(stage));
    if (implicit_solver)
      find_equilibrium(stage, trial);
    else
      try
      {
        come_to_rest(stage, base, trial);
      }
      catch (const ModelFailure &error)
      {
        log.message("stage " + stage.name + ": factor " + number_text(factor)
                    + ": " + error.what());
      }
      catch (const RunError &error)
      {
        throw RunError("stage '" + stage.name + "': " + error.what());
      }
    progress.finish(progress_figures(stage));
    trial.n_steps          = record.state.stage_step;
    trial.unbalanced_ratio = record.state.unbalanced_ratio;
    trial.displacement     = largest_displacement(base);
    const double seconds   = seconds_since(start);
    record.wall_time += seconds;
    seconds_done += seconds;
    steps_done += trial.n_steps;
    return trial;
  }

  void Simulation::come_to_rest(const StageParameters &stage,
                                const State<2> &base, SafetyTrial &trial)
  {
    const SafetyParameters &safety = *stage.safety;
    State<2> &state                = record.state;
    FailureWatch watch(safety.failure_displacement > 0.
                           ? safety.failure_displacement
                           : failure_share * diagonal(mesh));
    choose_time_step(stage);
    for (;;)
    {
      ExplicitSolver::Requests requests;
      requests.balance
          = state.stage_step % ExplicitSolver::balance_interval == 0;
      explicit_solver->step(state, requests);
      if (!requests.balance)
        continue;
      solver->check_finite(state);
      // What leaves the box has no equilibrium in it, even if the rest has. It
      // is back where the next trial begins: no warning.
      if (!explicit_solver->take_blocks_outside().empty())
        return;
      trial.is_stable = has_settled(stage, true);
      if (trial.is_stable || watch.has_failed(largest_displacement(base)))
        return;
      trial.is_decided = state.stage_step < stage.maximum_steps;
      if (!trial.is_decided)
        return;
      if (progress.due())
        progress.update(progress_figures(stage));
    }
  }

  void Simulation::find_equilibrium(const StageParameters &stage,
                                    SafetyTrial &trial)
  {
    try
    {
      while (!implicit_solver->is_over(record.state))
      {
        implicit_solver->step(record.state);
        write_iterations();
        implicit_solver->take_jumps();
        if (progress.due())
          progress.update(progress_figures(stage));
      }
      trial.is_stable = true;
    }
    catch (const ModelFailure &)
    {
      write_iterations();
      implicit_solver->take_jumps();
    }
  }

  double Simulation::largest_displacement(const State<2> &base) const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < model->exchange().n_owned(); ++i)
    {
      const double *now = record.state.nodes[i].u, *then = base.nodes[i].u;
      largest
          = std::max(largest, std::hypot(now[0] - then[0], now[1] - then[1]));
    }
    return dealii::Utilities::MPI::max(largest, communicator);
  }

  void Simulation::write_mechanism(const State<2> &base, const double factor)
  {
    State<2> now = record.state;
    solver->update_histories(now);
    BlockFields fields = block_fields(*model, now);
    // Of the blocks that are left.
    State<2> begin          = base;
    begin.block_marks       = now.block_marks;
    const BlockFields start = block_fields(*model, begin);
    for (std::size_t i = 0; i < fields.position.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        fields.position[i][d] += start.displacement[i][d];
        fields.displacement[i][d] -= start.displacement[i][d];
      }
    const std::string folder = output + "/mechanism";
    BlockOutput blocks(folder, communicator);
    blocks.start();
    blocks.write(factor, fields);
    JointOutput joints(folder, communicator);
    joints.start();
    joints.write(factor, joint_fields(*model, now));
    if (solver->contacts())
    {
      JointOutput contacts(folder, communicator, "contacts");
      contacts.start();
      contacts.write(factor, contact_fields(*solver->contacts(), now));
    }
  }

  void Simulation::report_safety(const unsigned int index)
  {
    const StageParameters &stage = parameters.stages[index];
    const FactorSearch &search   = record.searches[index];
    const double stable          = search.highest_stable();
    const double failing         = search.lowest_failing();
    const std::string begin      = "stage " + stage.name + ": ";
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
  }
} // namespace quoin
