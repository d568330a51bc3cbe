// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_explicit_solver_h
#define quoin_dynamics_explicit_solver_h

#include <quoin/dynamics/added_mass.h>
#include <quoin/dynamics/added_water.h>
#include <quoin/dynamics/central_differences.h>
#include <quoin/dynamics/highest_frequency.h>
#include <quoin/operators/state.h>
#include <quoin/model/model_box.h>
#include <quoin/dynamics/solver.h>

#include <memory>
#include <utility>
#include <vector>

namespace quoin
{
  /** The critical time step of a stage, and what mass scaling adds for it. */
  struct CriticalStep
  {
    double length = 0.; /**< [s], the same on all ranks */
    /** How many times as long the step of blocks, joints and contacts is,
        without stiffness-proportional damping, as that of the bound of each
        node. */
    double gain = 1.;
    AddedMass added;
  };

  /**
   * Explicit time integration (CentralDifferences) of blocks, joints, contacts
   * and far fields, stage by stage.
   *
   * Because the kinetic energy 1/2 v(t-dt/2) m v(t+dt/2) changes by exactly the
   * trapezoidal work of the forces, every account uses that rule and the energy
   * balance of an elastic model closes to rounding. In three dimensions there
   * are only deformable blocks and their loads.
   */
  template <int dim>
  class ExplicitSolver : public Solver<dim>
  {
  public:
    /**
     * Keeps references to @p model. @p loads: all loads of the run; @p stages:
     * all stages, as State::stage counts them, so that no block is removed that
     * a later one moves; @p far_field and @p static_far_field: of the load of
     * type 'boundary elements', or null; the second acts in static stages.
     * Throws an InputError about a block outside the box.
     */
    ExplicitSolver(Model<dim> &model, const std::vector<LoadParameters> &loads,
                   const std::vector<StageParameters> &stages       = {},
                   std::unique_ptr<FarField> far_field              = nullptr,
                   std::unique_ptr<StaticFarField> static_far_field = nullptr);

    void prepare(State<dim> &state) const override;

    /** Steps between checks of the unbalanced force, of NaN, and of the loading
        rate. */
    static constexpr std::uint64_t balance_interval = 100;

    /**
     * Sets the masses of @p previous, the stage at whose end @p state was
     * saved: kinetic energy is counted with them.
     */
    void restore_masses(const StageParameters &previous, State<dim> state)
    {
      scale_masses(previous, state.load_start(), state);
    }

    /** Quantities to be computed in a step; see step(). */
    struct Requests
    {
      bool energies = false;
      /** Unbalanced ratio, checks for NaN, inverted cells and blocks outside
          the box, and what follows the balance: every balance_interval steps.
       */
      bool balance = false;
      /** Unbalanced ratio for a row alone, which changes nothing that follows.
       */
      bool ratio = false;

      bool any_ratio() const
      {
        return ratio || balance;
      }
    };

    /**
     * Switches to the loads and the damping of @p stage. @p previous is the
     * previous stage or null. Throws an InputError about unknown loads, or
     * bodies without support in a static stage.
     */
    void begin_stage(const StageParameters &stage,
                     const StageParameters *previous, State<dim> &state);

    /** Does what begin_stage() does for a state from a checkpoint within a
     * stage. */
    void resume_stage(const StageParameters &stage,
                      const StageParameters *previous, State<dim> &state);

    /** Lets the critical step of the next stages be that of the assembled
        stiffness, unless keeps_bound(). */
    void take_assembled_step()
    {
      takes_assembled_step = true;
    }
    /** Critical time step of the stage. */
    const CriticalStep &critical_step() const
    {
      return critical;
    }
    /** Time in which forces may change without shaking the model: that of a
        shear wave along its diagonal and back, at least two thousand critical
        time steps, which joints are too soft for waves alone to tell [s]. */
    double quiet_time() const;
    /** The water that moves with faces in the stage. */
    const AddedWater<dim> &added_water() const
    {
      return water;
    }

    void set_time_step(const double dt)
    {
      time_step = dt;
    }
    double get_time_step() const
    {
      return time_step;
    }

    /**
     * Advances @p state from t to t + dt. Internal variables of joints,
     * energies(), reactions and the unbalanced ratio are then those of t.
     * Throws a RunError if the state is no longer valid.
     */
    void step(State<dim> &state, const Requests &requests);

    void update_histories(State<dim> &state) override;

    double stop_blocks(const std::vector<unsigned int> &blocks,
                       State<dim> &state) override;

    /** Blocks found outside the box since the last call. */
    std::vector<BlockOutside> take_blocks_outside()
    {
      return std::exchange(blocks_outside, {});
    }

    /** The force of a load; with added mass it has that of its inertia. */
    Resultant<dim> resultant(const std::string &load) const override;

  private:
    using Solver<dim>::model;
    using Solver<dim>::communicator;
    using Solver<dim>::all;
    using Solver<dim>::stage;
    using Solver<dim>::acting;
    using Solver<dim>::time_shares;

    /** Finds the masses in @p stage, which begins at @p start [s]. */
    void scale_masses(const StageParameters &stage, double start,
                      State<dim> &state);
    /** Collects what acts in the stage; @p previous: stage before, or null. */
    void collect_operators(const StageParameters *previous);
    void collect_constrained_nodes(const State<dim> &state);
    /** Time of a shear wave along the model and back, with added masses [s];
        0 if all blocks are rigid. */
    double passage_time() const;
    /** Whether the critical step is that of the bound in any case: with
        stiffness or damping that highest_squared_frequency() does not know,
        such as that of a far field with staggered coupling, with cells that may
        yield and then deform, and with masses scaled by the bound. */
    bool keeps_bound() const;
    /** Largest omega^2 of blocks, joints and contacts with the masses of the
        stage: by the bound of each node or, if that is wanted, of the assembled
        stiffness, then with its gain [1/s^2]. Collective. */
    double largest_eigenvalue(const StableTimeStep<dim> &stability);
    /** Bound of what the stiffness of the water adds to it [1/s^2]; collective.
     */
    double largest_water_eigenvalue() const;
    /** Time over which gravity that begins in the stage grows [s]. */
    double automatic_ramp() const;
    /** Duration of the release of held forces in this stage [s]. */
    double release_duration(const State<dim> &state) const;
    /** Lets the loads of the stage before grow on blocks that are placed, in a
        stage that ends at rest, and those go on that still grew at the end of
        the stage before, whose clock @p state has. */
    void begin_arrival(const StageParameters *previous,
                       State<dim> &state) const;
    /** Lets loads and the forces of water in joints grow on placed blocks in
       the stage of @p state. */
    void grow_on_placed(const State<dim> &state);
    /** Blocks of this rank that loads of this or a later stage move. */
    void find_moved_blocks(const State<dim> &state);
    /** Tells joints and contacts what their dashpots need of the blocks and of
        the loads that act. Collective. */
    void set_dashpots();
    /** Fixes the nodes of removed blocks. */
    void hold_removed_blocks(const State<dim> &state);
    void look_at_box(State<dim> &state);
    /**
     * Leaves blocks at rest and without strain, and books the energy that they
     * had as external work.
     */
    void remove_blocks(const std::vector<BlockOutside> &found,
                       State<dim> &state);
    /** Times and factors of the step; books what the last step left pending and
        looks for blocks outside the box. */
    StepContext begin_step(State<dim> &state, const Requests &requests);
    /** Adds all forces but those of blocks, and keeps what energies and sums
        need of the start of the step. */
    void add_forces(State<dim> &state, const StepContext &context,
                    const Requests &requests, StepSums &sums);
    void find_stored_energies(const State<dim> &state);
    void advance_rigid_blocks(State<dim> &state, const StepContext &context,
                              StepSums &sums);
    void advance_beams(State<dim> &state, const StepContext &context,
                       StepSums &sums);
    /** Moves nodes by constraints, and then all by the load pattern. */
    void move_constrained_nodes(State<dim> &state, const StepContext &context);
    void end_step(State<dim> &state, const StepContext &context,
                  const Requests &requests, const StepSums &sums);
    void book_energies(State<dim> &state, const StepContext &context,
                       const Requests &requests, const StepSums &sums);
    void account_for_new_step(State<dim> &state,
                              const StepContext &context) const;
    /** Advances time, step counts and load time to the next step. */
    void advance_time(State<dim> &state, const StepContext &context,
                      const Requests &requests) const;

    BlockContacts *const block_contacts; /**< null: small displacements */

    CentralDifferences<dim> stepper;
    std::vector<double> node_mass; /**< local nodes, with mass scaling [kg] */
    AddedWater<dim> water;
    bool takes_assembled_step = false;
    /** A stage is begun for the report at the start, too, and again by
        trials. */
    std::vector<KnownFrequency> known_frequencies;
    CriticalStep critical;
    double time_step = 0.;

    RigidBlockStage rigid_stage;
    std::unique_ptr<BeamMotion> beam_motion; /**< null: no beams */

    std::unique_ptr<const ModelBox> box; /**< null: no box */
    std::vector<StageParameters> all_stages;
    std::vector<bool> moved_blocks; /**< of this rank, moved by loads */
    std::vector<BlockOutside> blocks_outside;

    /** Velocities and, of this rank, stored energies before the step, when they
        are needed. */
    AlignedArray<dealii::Tensor<1, dim>> velocity_before;
    std::vector<RigidBlockState> rigid_before;
    EnergyAccounts stored_before;
    PlasticHistory plastic_now; /**< when energies are requested */

    const unsigned int energy_phase = time_shares.phase("energies"),
                       rigid_phase  = time_shares.phase("rigid blocks"),
                       beam_phase   = time_shares.phase("beams"),
                       load_phase   = time_shares.phase("loads");
  };

  // Members that exist in two dimensions only.
  template <>
  double ExplicitSolver<2>::largest_water_eigenvalue() const;
  template <>
  void ExplicitSolver<2>::look_at_box(State<2> &state);
  template <>
  void ExplicitSolver<2>::remove_blocks(const std::vector<BlockOutside> &found,
                                        State<2> &state);
} // namespace quoin

#endif
