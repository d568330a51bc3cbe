// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/load_advice.h>
#include <quoin/base/number_text.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/model_box.h>
#include <quoin/block_problem/block_stage.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/interruption.h>
#include <quoin/reinforcement/bar_results.h>
#include <quoin/results/result_origin.h>
#include <quoin/operators/stored_energy.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Automatic failure displacement, by the mean displacement with which the
        loads have deformed the model, or by its diagonal. */
    constexpr double failure_by_loading = 10., failure_by_diagonal = 1e-3;
    /** At least, by the diagonal, of implicit trials in which joints alone may
        fail, whose way costs few steps: columns that lean on each other come to
        rest after a thousand times the elastic displacement. */
    constexpr double failure_of_joints = 5e-3;
    /** At least, by the slip that mobilises the peak strength of joints, and by
        the motion along bolts that mobilises these, which may be at 70 degrees
        to the joint that slips; implicit trials may go beyond the limit. */
    constexpr double failure_by_slip = 2., failure_by_bolts = 6.;
    /** Share of the model's diagonal that is enough for bolts: soft ones
       without a strength would be mobilised where geometry has long changed. */
    constexpr double most_for_bolts = 0.02;
    /** Local damping of trials that confirm a failure: it lets blocks slide
        faster than the default does and damps chatter enough, but not the swing
        of blocks that bars or liners catch, which looks like a failure. */
    constexpr double confirming_damping = 0.5;
    /** Steps of a trial under adaptive damping, by those of the slowest one
        before that came to rest, after which local damping is to decide: under
        adaptive damping joints may chatter for long in a model that stands. */
    constexpr std::uint64_t patience = 4;
    /** Parts in which strengths are reduced. */
    constexpr unsigned int n_reductions = 20;
    /** Share of the failure displacement at which a trial of the implicit
        solver moves against drag. */
    constexpr double released_at = 0.1;

    /** Writes the unstable state at @p factor: mechanism/. Collective. */
    template <int dim>
    void write_mechanism(const BlockContext<dim> &context, const double factor)
    {
      const BlockSystem<dim> &system = context.system;
      ModelOutput<dim> mechanism(context.run.output + "/mechanism",
                                 *system.model, *system.solver,
                                 system.parameters.field_format);
      mechanism.start();
      mechanism.write(factor, context.state);
    }

    template <int dim>
    class SafetyStage : public BlockStage<dim>
    {
      using BlockStage<dim>::context;
      using BlockStage<dim>::index;
      using BlockStage<dim>::log;
      using BlockStage<dim>::outputs;
      using BlockStage<dim>::stage;
      using BlockStage<dim>::state;
      using BlockStage<dim>::system;

    public:
      using typename Stage::Checkpoint;

      SafetyStage(BlockContext<dim> &context, const unsigned int index)
        : BlockStage<dim>(context, index), safety(*stage.safety),
          search(context.searches[index]), base(state),
          strong(system.model->properties())
      {
        if (const StageParameters *previous
            = previous_stage(system.parameters.stages, index))
          raised = previous->strength_factor;
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
        ProgressFigures figures = this->figures_at(-1.);
        if (!search.has_ended(safety))
          figures.stage += text_of(", factor ", search.next(safety));
        return figures;
      }

    private:
      void finish() override;
      /** Warns where water that stays as it is in the mesh holds ground that
          has moved before it came to rest at the factor @p stable. */
      void warn_of_moved_water(double stable);
      /** Sets strengths after @p share of the way from those of the start of
          the stage to those of the parameters, divided by @p factor. */
      void set_strength(double factor, double share);
      SafetyTrial try_factor(double factor);
      /** Begins the stage, damped as @p variant of it, with the state before.
       */
      void begin_trial(const StageParameters &variant);
      /** Takes at most @p most_steps steps. */
      void come_to_rest(const StageParameters &variant,
                        std::uint64_t most_steps, SafetyTrial &trial);
      void find_equilibrium(SafetyTrial &trial);
      /** What rest proves: nothing if the model has moved on before, beyond
          @p limit [m]. */
      void judge_rest(bool moved_on, double limit, SafetyTrial &trial) const;
      /** Whether a failure may come from joints that chatter under adaptive
          damping, so that a trial with local damping must confirm it. */
      bool needs_confirmation() const;
      bool is_reinforced() const
      {
        return system.solver->loads().beams
               || !system.model->reinforcement().empty();
      }
      /** Looks whether a signal asks the run to end, which gives up the trial:
          a resumed run begins it anew. Collective. */
      bool is_interrupted();
      /** Displacement beyond which a trial may fail [m]; collective. */
      double failure_displacement() const
      {
        return failure_displacement(only_joints_fail());
      }
      /** Displacement beyond which a trial may fail [m], which is at least
          failure_of_joints if @p of_joints; collective. */
      double failure_displacement(bool of_joints) const;
      /** Whether trials are implicit and find nothing but joints that fail.
          Collective. */
      bool only_joints_fail() const;
      /** Writes @p limit, the failure displacement [m], to the log once. */
      void note_limit(double limit);
      /** Largest one since the start of the stage [m]; collective. */
      double largest_displacement() const;

      const SafetyParameters &safety;
      FactorSearch &search;
      const State<dim> base;
      /** Energies at the start of the search. */
      const Energies energies = system.solver->energies();
      ModelProperties strong;
      /** Ratio of trial strength to that of the parameters. */
      double raised    = 1.;
      bool interrupted = false; /**< the present trial */
      bool has_noted   = false; /**< see note_limit() */
    };

    template <int dim>
    Stage::Checkpoint SafetyStage<dim>::take_step()
    {
      const SafetyTrial trial = try_factor(search.next(safety));
      if (interrupted)
      {
        state = base;
        system.solver->set_energies(energies);
        return Checkpoint::kept;
      }
      log.message("stage ", stage.name, ": factor ", trial.factor, " is ",
                  verdict_text(trial.verdict), " after ", trial.n_steps,
                  " steps, largest displacement ", trial.displacement, " m");
      if (trial.verdict == Verdict::failing
          && trial.factor < search.lowest_failing())
        write_mechanism(context, trial.factor);
      search.add(trial);
      state = base;
      system.set_properties(strong, state);
      system.solver->set_energies(energies);
      context.run.on_first_rank(
          [&]()
          { write_text(context.run.output + "/safety.csv", search.table()); });
      return Checkpoint::wanted;
    }

    template <int dim>
    void SafetyStage<dim>::set_strength(const double factor, const double share)
    {
      system.set_properties(reduced(reduced(strong, std::pow(raised, share)),
                                    std::pow(factor, share),
                                    safety.reduces_joints,
                                    safety.reduces_blocks),
                            state);
    }

    template <int dim>
    void SafetyStage<dim>::begin_trial(const StageParameters &variant)
    {
      state = base;
      system.set_properties(strong, state);
      system.begin_stage(index, state, false, &variant);
      // The mechanism is what moves from here on.
      count_from(*system.model, { true, true, true }, state);
    }

    template <int dim>
    SafetyTrial SafetyStage<dim>::try_factor(const double factor)
    {
      SafetyTrial trial;
      trial.factor = factor;
      // Chatter that misled adaptive damping once would do so again.
      const bool may_mislead = needs_confirmation();
      if (!may_mislead || !search.was_misled())
      {
        begin_trial(stage);
        context.run.progress.start(figures());
        if (system.implicit_solver)
          find_equilibrium(trial);
        else
        {
          const std::uint64_t slowest = search.slowest_rest();
          come_to_rest(stage,
                       may_mislead && slowest > 0
                           ? std::min(patience * slowest, stage.maximum_steps)
                           : stage.maximum_steps,
                       trial);
        }
        if (trial.verdict == Verdict::stable)
          trial.n_to_rest = state.stage_step;
        else if (may_mislead && !interrupted)
        {
          context.run.progress.finish(figures());
          log.message("stage ", stage.name, ": factor ", factor, " is ",
                      verdict_text(trial.verdict),
                      " under adaptive damping, which chattering joints may "
                      "mislead; it is tried again with local damping");
          trial.n_steps = state.stage_step;
        }
      }
      if (may_mislead && trial.verdict != Verdict::stable && !interrupted)
      {
        StageParameters local = stage;
        local.damping         = DampingType::local;
        local.local_coefficient
            = is_reinforced() ? default_local_damping : confirming_damping;
        begin_trial(local);
        context.run.progress.start(figures());
        come_to_rest(local, stage.maximum_steps, trial);
      }
      if (interrupted)
        return trial;
      context.run.progress.finish(figures());
      trial.n_steps += state.stage_step;
      trial.unbalanced_ratio = state.unbalanced_ratio;
      trial.displacement     = largest_displacement();
      context.n_done += trial.n_steps;
      return trial;
    }

    template <int dim>
    bool SafetyStage<dim>::needs_confirmation() const
    {
      return system.explicit_solver && stage.damping == DampingType::adaptive
             && (system.nodes->faces().n_global_joints > 0
                 || system.model->contacts());
    }

    template <int dim>
    bool SafetyStage<dim>::is_interrupted()
    {
      interrupted = dealii::Utilities::MPI::max(Interruption::received(),
                                                context.run.communicator)
                    != 0;
      return interrupted;
    }

    template <int dim>
    void SafetyStage<dim>::come_to_rest(const StageParameters &variant,
                                        const std::uint64_t most_steps,
                                        SafetyTrial &trial)
    {
      ExplicitSolver<dim> &solver = *system.explicit_solver;
      context.steps.choose(variant);
      // A sudden loss of strength would make the model overshoot.
      const double start = state.time, duration = solver.quiet_time();
      const double limit = failure_displacement();
      note_limit(limit);
      FailureWatch watch(limit, start + duration);
      unsigned int n_reduced = 0;
      trial.verdict          = Verdict::undecided;
      try
      {
        for (;;)
        {
          const double share = (state.time - start) / duration;
          if (n_reduced < n_reductions
              && share >= double(n_reduced) / n_reductions)
          {
            ++n_reduced;
            set_strength(trial.factor, double(n_reduced) / n_reductions);
          }
          typename ExplicitSolver<dim>::Requests requests;
          requests.balance
              = state.stage_step % ExplicitSolver<dim>::balance_interval == 0;
          if (state.stage_step > 1)
            note_failed_joints(state);
          solver.step(state, requests);
          if (!requests.balance)
            continue;
          solver.check_finite(state);
          // A block that leaves the box has failed, even if the rest has not.
          // It is back at the start of the next trial: no warning.
          if (!solver.take_blocks_outside().empty()
              || watch.has_failed(state.time, largest_displacement()))
            trial.verdict = Verdict::failing;
          // Forces as small as those of an equilibrium may make blocks creep.
          else if (share >= 1. && this->has_settled()
                   && !watch.creeps(
                       (double(stage.maximum_steps) - double(state.stage_step))
                       * solver.get_time_step()))
          {
            judge_rest(watch.has_moved_on(), limit, trial);
            return;
          }
          if (trial.verdict != Verdict::undecided
              || state.stage_step >= most_steps || is_interrupted())
            return;
          if (context.run.progress.due())
            context.run.progress.update(figures());
        }
      }
      catch (const BlockLeftBox &error)
      {
        log.message("stage ", stage.name, ": factor ", trial.factor, ": ",
                    error.what());
        trial.verdict = Verdict::failing;
      }
      catch (const ModelFailure &error)
      {
        log.message("stage ", stage.name, ": factor ", trial.factor, ": ",
                    error.what());
        if (largest_displacement() > limit)
          trial.verdict = Verdict::failing;
      }
      catch (const RunError &error)
      {
        throw RunError("stage '" + stage.name + "': " + error.what());
      }
    }

    template <int dim>
    void SafetyStage<dim>::find_equilibrium(SafetyTrial &trial)
    {
      ImplicitSolver<dim> &solver = *system.implicit_solver;
      set_strength(trial.factor, 1.);
      solver.begin_stage(stage, previous_stage(system.parameters.stages, index),
                         state);
      const double limit = failure_displacement();
      note_limit(limit);
      // Trials that may go farther begin to move against drag as early.
      const double early = failure_displacement(false);
      JumpWatch watch(limit);
      double last   = 0.; // largest displacement after the last step [m]
      trial.verdict = Verdict::undecided;
      try
      {
        while (!solver.has_ended(state))
        {
          if (is_interrupted())
            return;
          const State<dim> before = state;
          solver.step(state);
          note_failed_joints(state);
          outputs.write_iterations();
          solver.record().jumps.clear();
          const double displacement = largest_displacement();
          // Forces that are released slowly may lead ground that flows from one
          // equilibrium to the next, until it lies as a heap. Whether it keeps
          // moving shows when it is released early, as the explicit solver
          // does, whose displacements count from the start. An equilibrium
          // farther away than the limit in one step may be one that the model
          // would never reach, such as that of a block that swung on a bolt.
          const auto &was = before.template get<ImplicitState>();
          if (!was.jumps
              && (was.released < 1. ? displacement > released_at * early
                                    : displacement > last + early))
          {
            state = before;
            solver.move_against_drag(state);
            continue;
          }
          last            = displacement;
          const auto &now = state.template get<ImplicitState>();
          if (watch.has_failed(now.jumps, now.drag_time, displacement))
          {
            trial.verdict = Verdict::failing;
            return;
          }
          if (context.run.progress.due())
            context.run.progress.update(figures());
        }
        judge_rest(watch.has_moved_on(), limit, trial);
      }
      catch (const ModelFailure &error)
      {
        const std::string why = error.what();
        log.message("stage ", stage.name, ": factor ", trial.factor, ": ",
                    why.substr(0, why.find(". ")),
                    ": steps and displacement are those of the last one");
        outputs.write_iterations();
        solver.record().jumps.clear();
      }
    }

    template <int dim>
    void SafetyStage<dim>::judge_rest(const bool moved_on, const double limit,
                                      SafetyTrial &trial) const
    {
      if (!moved_on)
        trial.verdict = Verdict::stable;
      else
        log.message("stage ", stage.name, ": factor ", trial.factor,
                    ": the model reached equilibrium after it had moved beyond "
                    "the failure displacement of ",
                    limit,
                    " m, so that this factor is neither stable nor unstable");
    }

    template <int dim>
    bool SafetyStage<dim>::only_joints_fail() const
    {
      return system.implicit_solver && safety.reduces_joints && !is_reinforced()
             && system.nodes->faces().n_global_joints > 0
             && dealii::Utilities::MPI::max(
                    unsigned(system.model->blocks().cell_data().is_plastic()),
                    context.run.communicator)
                    == 0;
    }

    template <int dim>
    double SafetyStage<dim>::failure_displacement(const bool of_joints) const
    {
      if (safety.failure_displacement > 0.)
        return safety.failure_displacement;
      const Model<dim> &model = *system.model;
      double energy = stored_energy(base, model.blocks(), model.joints());
      if constexpr (dim == 2)
        if (const BlockContacts *contacts = system.model->contacts())
          energy += stored_energy(base, *contacts);
      const StageLoads<dim> &loads = system.solver->stage_loads();
      const auto absent            = absent_nodes(model, base);
      const auto force_at          = [&](const double load_time)
      {
        const TimePoint time{ load_time, base.next_load_start() + load_time };
        AlignedArray<dealii::Tensor<1, dim>> forces(base.nodes.size(),
                                                    dealii::Tensor<1, dim>());
        for (const NodalLoad<dim> *load : loads.nodal)
          load->add_loads(time, forces.data());
        loads.arrival.add_loads(time, forces.data());
        model.nodes().exchange().add_to_owners(forces.data());
        double sum = 0.;
        for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
          if (!absent[i])
            sum += forces[i].norm();
        return dealii::Utilities::MPI::sum(sum, context.run.communicator);
      };
      energy = dealii::Utilities::MPI::sum(energy, context.run.communicator);
      const double force = force_at(0.);
      // Loads that still grow will displace the model in proportion.
      const double growth   = loads.growth();
      const double grown    = force > 0. && growth > 0.
                                  ? std::max(1., force_at(growth) / force)
                                  : 1.;
      const double diagonal = system.nodes->table().diagonal();
      double least          = 0.;
      for (const JointSetParameters &set : strong.joints)
        least = std::max(least, failure_by_slip * slip_of_peak(set.law));
      if (of_joints)
        least = std::max(least, failure_of_joints * diagonal);
      if constexpr (dim == 2)
        if (!model.reinforcement().empty())
        {
          const double wanted
              = failure_by_bolts
                / (system.implicit_solver ? JumpWatch::far_beyond : 1.)
                * mobilising_motion(model.reinforcement(), base, grown * force);
          least = std::max(least, std::min(wanted, most_for_bolts * diagonal));
        }
      return std::max(least,
                      force > 0. && energy > 0.
                          ? failure_by_loading * grown * 2. * energy / force
                          : failure_by_diagonal * diagonal);
    }

    template <int dim>
    void SafetyStage<dim>::note_limit(const double limit)
    {
      if (!has_noted && search.trials().empty())
        log.message("stage ", stage.name, ": trials may fail beyond ", limit,
                    " m, 'Failure displacement'");
      has_noted = true;
    }

    template <int dim>
    double SafetyStage<dim>::largest_displacement() const
    {
      double largest = 0.;
      for (unsigned int i = 0; i < system.model->nodes().n_owned(); ++i)
        largest
            = std::max(largest, (state.nodes[i].u - base.nodes[i].u).norm());
      return dealii::Utilities::MPI::max(largest, context.run.communicator);
    }

    template <int dim>
    void SafetyStage<dim>::warn_of_moved_water(const double stable)
    {
      const unsigned int yields
          = system.model->blocks().cell_data().is_plastic();
      if (dealii::Utilities::MPI::max(yields, context.run.communicator) == 0)
        return;
      Advice advice;
      for (const SafetyTrial &trial : search.trials())
        if (trial.verdict == Verdict::stable && trial.factor == stable)
          check_moved_water(system.parameters, index, stable,
                            trial.displacement, *system.nodes, advice);
      for (const std::string &text : advice)
        log.warning(text);
    }

    template <int dim>
    void SafetyStage<dim>::finish()
    {
      const double stable     = search.highest_stable();
      const double failing    = search.lowest_failing();
      const auto open         = search.undecided();
      const std::string begin = "stage " + stage.name + ": ";
      if (open)
        log.warning(
            begin, "factors from ", (*open)[0], " to ", (*open)[1],
            ": their trials are undecided, because the model neither reached "
            "equilibrium nor kept moving, or reached it beyond the failure "
            "displacement. ",
            system.implicit_solver
                ? "The log says why of each. Lower 'First step' of section "
                  "'Implicit' or 'Failure displacement', or search with "
                  "'Solver = explicit'."
                : "Raise 'Maximum steps', lower 'Failure displacement' if "
                  "blocks keep moving without reaching it, or raise it if "
                  "blocks may settle beyond it.",
            " Until then the factor of safety is ",
            stable == 0. ? "not known to be above any" : "at least ",
            stable == 0. ? std::string() : text_of(stable));
      if (stable == 0. && !open)
        log.warning(begin, "even the lowest factor, ", failing,
                    ", is unstable: the model has no equilibrium under these "
                    "loads, or 'Lowest factor' is too high");
      else if (std::isinf(failing) && !open)
        log.warning(begin, "even the highest factor, ", stable,
                    ", is stable: the model may have no mechanism");
      else if (!open)
        log.message(begin, "factor of safety ", 0.5 * (stable + failing),
                    ", stable at ", stable, ", failing at ", failing);
      else if (stable > 0. && std::isfinite(failing))
        log.message(begin, "factor of safety between ", stable,
                    ", stable, and ", failing, ", failing");
      const auto &materials = system.parameters.model.materials;
      if (safety.reduces_blocks
          && std::any_of(materials.begin(), materials.end(),
                         [](const MaterialParameters &material)
                         { return material.strength.has_value(); }))
        log.message(begin,
                    "elements that yield are stronger than the ground itself, "
                    "so factors are above those of finer meshes: "
                    "scripts/mesh_convergence estimates by how much");
      warn_of_moved_water(stable);
      if (is_reinforced())
        log.message(begin, "bolts, cables, beams and the interfaces of liners "
                           "kept their strength");
      log.message(begin, search.trials().size(), " trials of ",
                  search.n_steps(), " steps in all");
      if (system.explicit_solver)
        system.explicit_solver->restore_masses(
            *previous_stage(system.parameters.stages, index), state);
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Stage> make_safety_stage(BlockContext<dim> &context,
                                           const unsigned int index)
  {
    return std::make_unique<SafetyStage<dim>>(context, index);
  }

  template std::unique_ptr<Stage> make_safety_stage(BlockContext<2> &,
                                                    unsigned int);
  template std::unique_ptr<Stage> make_safety_stage(BlockContext<3> &,
                                                    unsigned int);
} // namespace quoin
