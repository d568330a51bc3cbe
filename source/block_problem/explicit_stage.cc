// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/known_names.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/state_checks.h>
#include <quoin/block_problem/block_stage.h>
#include <quoin/output/checkpoint_clock.h>
#include <quoin/results/result_origin.h>

namespace quoin
{
  namespace
  {
    /** Share of its mean speed in the stage below which a block has nearly
        stopped [-]. */
    constexpr double slow = 0.1;

    template <int dim>
    class ExplicitStage : public BlockStage<dim>
    {
    public:
      ExplicitStage(BlockContext<dim> &context, const unsigned int index)
        : BlockStage<dim>(context, index), solver(*system.explicit_solver)
      {
      }

      void begin() override
      {
        this->begin_model();
        warn_of_momentary_forces();
        context.displaced = farthest_node(*system.model, state).distance;
        prepare();
      }
      void resume() override
      {
        system.resume_stage(index, state);
        prepare();
      }
      bool has_ended() const override
      {
        return over;
      }
      Stage::Checkpoint take_step() override;
      ProgressFigures figures() const override
      {
        return this->figures_at(stage.end == StageEnd::time
                                    ? state.load_time / stage.duration
                                    : -1.);
      }

    private:
      using BlockStage<dim>::context;
      using BlockStage<dim>::system;
      using BlockStage<dim>::outputs;
      using BlockStage<dim>::log;
      using BlockStage<dim>::index;
      using BlockStage<dim>::stage;
      using BlockStage<dim>::state;
      using Checkpoint = Stage::Checkpoint;

      /** Warns if boundaries that absorb keep the forces of waves under way.
       */
      void warn_of_momentary_forces() const;
      /** Prepares the stage, which may end before its first step. */
      void prepare();
      /** Whether the stage's last row is due at the next step. */
      bool may_be_last(bool balance) const;
      /** Whether a stage with automatic rate control ends at @p load_time [s].
       */
      bool loads_are_over(double load_time) const;
      /** Whether a stage that ends by time has ended. */
      bool time_is_over() const;
      /** Throws a RunError if the stage has taken too many steps. */
      bool ends_here(bool balance) const;
      /** Whether static boundary elements are all that holds the model. */
      bool rests_on_far_field_alone() const;
      /** Whether a condition ends the stage here: boundary elements finish
          their step. */
      bool condition_ends_here() const;
      /** Fails if a block of a static stage moves on and on. */
      void look_for_lost_blocks();
      void report_blocks_outside();

      ExplicitSolver<dim> &solver;
      bool over = false;
    };

    template <int dim>
    void ExplicitStage<dim>::warn_of_momentary_forces() const
    {
      /** Kinetic energy by the largest so far, velocities of a hundredth, and
          by what is stored, stresses of a ten-thousandth, below which the model
          is at rest [-]. */
      constexpr double by_largest = 1e-4, by_stored = 1e-8;
      if (index == 0)
        return;
      // What has come to rest has done so to the accuracy that was asked for.
      const StageParameters &previous = system.parameters.stages[index - 1];
      const bool has_settled          = previous.end == StageEnd::static_ratio
                               && context.outcomes[index - 1].condition.empty();
      const auto begun = solver.loads().loads_that_hold(stage, previous);
      if (has_settled || begun.empty())
        return;
      double kinetic = 0.;
      for (unsigned int i = 0; i < system.model->nodes().n_owned(); ++i)
        kinetic
            += 0.5 * system.model->mass()[i] * state.velocity[i].norm_square();
      kinetic = dealii::Utilities::MPI::sum(kinetic, context.run.communicator);
      if (kinetic <= by_largest * outputs.largest().kinetic
          || kinetic <= by_stored * solver.energies().sum(EnergyKind::stored))
        return;
      const bool one = begun.size() == 1;
      log.warning(
          "stage ", stage.name, ": the model moves, with a kinetic energy of ",
          kinetic, " J, when the load", one ? " " : "s ", known_names(begun),
          one ? " begins" : " begin",
          ". What supports the boundary at this moment is kept constant from "
          "now on, forces of waves under way included, so that the model "
          "drifts. Let one load act in this stage and the one before, with a "
          "function of the time T of the run, or let the motion die out "
          "between them.");
    }

    template <int dim>
    void ExplicitStage<dim>::prepare()
    {
      context.steps.choose(stage);
      solver.discard_saved(state);
      over = (stage.end == StageEnd::time && time_is_over())
             || condition_ends_here();
    }

    template <int dim>
    bool ExplicitStage<dim>::condition_ends_here() const
    {
      if constexpr (dim == 2)
        if (solver.loads().far.elastodynamic_acts
            && state.template get<FarFieldState>().substep > 0)
          return false;
      return this->is_to_end();
    }

    template <int dim>
    Stage::Checkpoint ExplicitStage<dim>::take_step()
    {
      const double dt = solver.get_time_step();
      const bool balance
          = state.stage_step % ExplicitSolver<dim>::balance_interval == 0;
      if (balance && stage.end == StageEnd::static_ratio)
        look_for_lost_blocks();
      if (balance)
        this->follow_joint_motion();
      // Failures in the first step are due to motion before the stage.
      if (state.stage_step > 1)
        note_failed_joints(state);
      if (outputs.fields_are_due(state.time, dt))
        outputs.write_fields(state);

      const bool row_is_due = outputs.row_is_due(state.time, dt);
      typename ExplicitSolver<dim>::Requests requests;
      requests.energies = row_is_due || may_be_last(balance);
      requests.balance  = balance;
      requests.ratio    = row_is_due && outputs.histories().need_balance();
      if (requests.energies)
        this->before_row();
      try
      {
        solver.step(state, requests);
      }
      catch (const RunError &error)
      {
        throw RunError("stage '" + stage.name + "': " + error.what());
      }
      ++context.n_done;
      if (balance && stage.damping == DampingType::local)
        context.damping_shares[index].add(stage.local_coefficient
                                          * state.unbalanced_ratio);
      report_blocks_outside();
      over = ends_here(balance);
      if (row_is_due || over)
      {
        solver.check_finite(state);
        this->write_row();
      }
      over = over || condition_ends_here();
      if (balance || over)
        context.run.tables.check();
      return state.stage_step % CheckpointClock::steps_between_looks == 0
                 ? Checkpoint::possible
                 : Checkpoint::no;
    }

    template <int dim>
    bool ExplicitStage<dim>::may_be_last(const bool balance) const
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

    template <int dim>
    bool ExplicitStage<dim>::loads_are_over(const double load_time) const
    {
      return load_time >= (1. - 1e-12) * stage.duration;
    }

    template <int dim>
    bool ExplicitStage<dim>::time_is_over() const
    {
      return stage.slows_loads() ? loads_are_over(state.load_time)
                                 : state.stage_step >= context.steps.n_steps();
    }

    template <int dim>
    bool ExplicitStage<dim>::ends_here(const bool balance) const
    {
      const bool by_time = stage.end == StageEnd::time;
      if (by_time ? time_is_over() : balance && this->has_settled())
        return true;
      if (state.stage_step < stage.maximum_steps
          || (by_time && !stage.slows_loads()))
        return false;
      if (by_time)
        throw RunError(text_of(
            "stage '", stage.name, "' has not ended within ",
            stage.maximum_steps, " steps: its loads are at ", state.load_time,
            " of ", stage.duration, " s and go on at the rate ",
            state.load_rate,
            ". Raise 'Kinetic energy limit' or 'Maximum steps', or damp "
            "more."));
      throw RunError(
          text_of("stage '", stage.name, "' has not settled within ",
                  stage.maximum_steps, " steps: the unbalanced ratio is ",
                  state.unbalanced_ratio, " instead of ", stage.static_ratio,
                  ". The model may have no equilibrium under these loads",
                  rests_on_far_field_alone()
                      ? ": boundary elements alone resist no net force, such "
                        "as a weight that no initial stress balances, because "
                        "in the plane unbounded rock has no equilibrium under "
                        "it. Hold a boundary, or leave that load out"
                      : "",
                  "; otherwise raise 'Maximum steps' or damp more."));
    }

    template <int dim>
    bool ExplicitStage<dim>::rests_on_far_field_alone() const
    {
      const auto &constraints = solver.stage_loads().constraints;
      return solver.loads().far.elastostatic_acts && constraints.size() == 1
             && !solver.stage_loads().nodal.empty();
    }

    template <int dim>
    void ExplicitStage<dim>::look_for_lost_blocks()
    {
      const FarthestNode<dim> lost = farthest_node(*system.model, state);
      const double diagonal        = system.nodes->table().diagonal();
      // It was displaced by no more than the farthest one was.
      const double moved = lost.distance - context.displaced;
      if (moved <= diagonal
          || lost.speed * (state.time - state.stage_start) < slow * moved)
        return;
      this->fail(text_of(
          "block ", lost.block, ", from ", point_text(lost.before), " m to ",
          point_text(lost.now), " m, has moved by ", moved,
          " m or more since the stage began, farther than the diagonal of the "
          "model, ",
          diagonal, " m, and moves on at ", lost.speed, " m/s, found at time ",
          state.time, " s, step ", state.step,
          ": the stage will not reach equilibrium. Check the supports, and the "
          "units and signs of the loads; a model that may collapse needs 'End "
          "conditions'",
          dim == 2 ? ", and blocks that may fall a 'Box' in section 'Contact' "
                     "and 'Outside the box = delete'."
                   : "."));
    }

    template <int dim>
    void ExplicitStage<dim>::report_blocks_outside()
    {
      const bool removes = system.parameters.model.contact.outside
                           == ContactParameters::Outside::remove;
      for (const BlockOutside &block : solver.take_blocks_outside())
      {
        const auto lost = outputs.write_block_outside(block);
        log.warning("block ", block.block, ", at (", block.position[0], ", ",
                    block.position[1], ") m, has left the box at time ",
                    block.time, " s",
                    block.removed ? " and is deleted"
                    : removes
                        ? "; it stays in the model, because a load moves it or "
                          "joints tie it to a block that stays"
                        : "",
                    lost.empty() ? ""
                                 : ": histories in it are 'nan' from now on: "
                                       + known_names(lost));
      }
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Stage> make_explicit_stage(BlockContext<dim> &context,
                                             const unsigned int index)
  {
    return std::make_unique<ExplicitStage<dim>>(context, index);
  }

  template std::unique_ptr<Stage> make_explicit_stage(BlockContext<2> &,
                                                      unsigned int);
  template std::unique_ptr<Stage> make_explicit_stage(BlockContext<3> &,
                                                      unsigned int);
} // namespace quoin
