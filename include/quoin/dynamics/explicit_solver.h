// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_explicit_solver_h
#define quoin_dynamics_explicit_solver_h

#include <quoin/dynamics/central_differences.h>
#include <quoin/operators/state.h>
#include <quoin/dynamics/model_box.h>
#include <quoin/dynamics/solver.h>

#include <memory>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * Explicit steps (CentralDifferences) of blocks, joints, contacts and far
   * fields for one stage after the other.
   *
   * Because the kinetic energy 1/2 v(t-dt/2) m v(t+dt/2) changes by exactly
   * the trapezoidal work of the forces, every account is kept with that rule
   * and the balance of an elastic model closes to rounding.
   */
  class ExplicitSolver : public Solver
  {
  public:
    /**
     * Keeps references to @p model. @p loads: all loads of the run;
     * @p stages: all stages, as State::stage counts them, so that no block is
     * removed that a later one moves; @p far_field and @p static_far_field: of
     * the load that is of the type 'boundary elements', or null; the second
     * acts in static stages. Throws an InputError about a block outside the
     * box.
     */
    ExplicitSolver(Model &model, const std::vector<LoadParameters> &loads,
                   const std::vector<StageParameters> &stages       = {},
                   std::unique_ptr<FarField> far_field              = nullptr,
                   std::unique_ptr<StaticFarField> static_far_field = nullptr);

    void prepare(State<2> &state) const override;

    /**
     * Books the energy of @p state, which is not at rest where the run begins,
     * as brought in from outside. Throws an InputError if rigid blocks move;
     * collective.
     */
    void account_for_initial_motion(State<2> &state) const;

    /** Steps between looks at unbalanced force, at NaN, and at the rate of
        loads. */
    static constexpr std::uint64_t balance_interval = 100;

    /**
     * Masses become those of @p previous, the stage at whose end @p state was
     * saved: the energy of what moves is counted with them.
     */
    void restore_masses(const StageParameters &previous, State<2> state)
    {
      scale_masses(previous, state);
    }

    /** What is due at the time of a step; see step(). */
    struct Requests
    {
      bool energies = false;
      /** Unbalanced ratio and a look for NaN, spoilt cells and blocks that
          have left the box. */
      bool balance = false;
    };

    /**
     * Switches to the loads and the damping of @p stage. @p previous is the
     * stage before or null. Throws an InputError about unknown loads, or
     * bodies that a static stage would let drift.
     */
    void begin_stage(const StageParameters &stage,
                     const StageParameters *previous, State<2> &state);

    /** The same for a state read from a checkpoint in mid-stage. */
    void resume_stage(const StageParameters &stage, State<2> &state);

    /** Critical time step of the stage [s], the same on all ranks. */
    double critical_time_step() const
    {
      return critical_step;
    }
    /** Mass added by mass scaling, as a share of the model's. */
    double added_mass_share() const
    {
      return added_mass;
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
     * Advances @p state from t to t + dt. Joint histories are then those of
     * t; energies(), reactions and the unbalanced ratio are those of t too.
     * Throws a RunError if the state is no longer sound.
     */
    void step(State<2> &state, const Requests &requests);

    void update_histories(State<2> &state) override;

    double stop_blocks(const std::vector<unsigned int> &blocks,
                       State<2> &state) override;

    /** Blocks found outside the box since the last call. */
    std::vector<BlockOutside> take_blocks_outside()
    {
      return std::exchange(blocks_outside, {});
    }

    /** Laws of all joint sets for contacts that come and go, if any do. */
    void set_contact_laws(const std::vector<JointSetParameters> &sets)
    {
      if (block_contacts)
        block_contacts->set_laws(sets);
    }

    const BlockContacts *contacts() const override
    {
      return block_contacts.get();
    }

  private:
    void scale_masses(const StageParameters &stage, State<2> &state);
    /** What acts in the stage; @p previous: the stage before, or null. */
    void collect_operators(const StageParameters *previous);
    void collect_constrained_nodes(const State<2> &state);
    /** How long forces of excavated blocks are let go in this stage [s]. */
    double release_duration(const State<2> &state) const;
    /** Blocks of this rank that loads of this or a later stage move. */
    void find_moved_blocks(const State<2> &state);
    /** Makes removed blocks stay where they are. */
    void hold_removed_blocks(const State<2> &state);
    void look_at_box(State<2> &state);
    /**
     * Leaves blocks at rest and without strain, and books what energy they
     * had as done from outside.
     */
    void remove_blocks(const std::vector<BlockOutside> &found, State<2> &state);
    /** Energies of a step's start, of this rank [J]. */
    struct StoredEnergies
    {
      double strain = 0., joint = 0.;
    };
    StoredEnergies stored_energies(const State<2> &state);
    void advance_rigid_blocks(State<2> &state, const StepContext &context,
                              StepSums &sums);
    void book_energies(State<2> &state, const StepContext &context,
                       const Requests &requests, const StoredEnergies &stored,
                       const StepSums &sums);
    void account_for_new_step(State<2> &state,
                              const StepContext &context) const;
    /** Time, steps and the loads' clock of the next step. */
    void advance_time(State<2> &state, const StepContext &context,
                      const Requests &requests) const;

    std::unique_ptr<BlockContacts> block_contacts;

    CentralDifferences<2> stepper;
    double critical_step = 0.;
    double added_mass    = 0.;
    double time_step     = 0.;

    RigidBlockStage rigid_stage;

    const ModelBox box;
    std::vector<StageParameters> all_stages;
    std::vector<bool> moved_blocks; /**< of this rank, by loads */
    std::vector<BlockOutside> blocks_outside;

    std::vector<RigidBlockState> rigid_before;
    PlasticHistory plastic_now; /**< when energies are due */

    const unsigned int energy_phase = time_shares.phase("energies"),
                       rigid_phase  = time_shares.phase("rigid blocks");
  };
} // namespace quoin

#endif
