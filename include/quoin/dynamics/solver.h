// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_solver_h
#define quoin_dynamics_solver_h

#include <quoin/base/phase_clock.h>
#include <quoin/operators/state.h>
#include <quoin/model/model.h>
#include <quoin/loading/run_loads.h>
#include <quoin/loading/stage_loads.h>
#include <quoin/stages/stage_parameters.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  struct GrowingWater;

  /** Energies of the whole model at one time [J]. */
  struct Energies : EnergyAccounts
  {
    /** Stored energy of the operators at the start, which determines the
        rounding error of their energies since then. */
    double at_start = 0.;

    /** Error of the energy balance [J]; zero but for rounding and kinks. */
    double residual() const
    {
      return sum(EnergyKind::stored) + sum(EnergyKind::dissipated)
             - sum(EnergyKind::given);
    }

    /** Energy throughput, the scale of the residual [J]. */
    double throughput() const;

    /** Archives all of them: a run that is resumed in the trial of a factor of
        safety computes none before its end. */
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      for (const EnergyAccount &account : energy_accounts)
        archive &this->*account.value;
      archive &at_start;
    }
  };

  /**
   * Base of all solvers: the loads of a run and those that act in the stage,
   * the energies. Rigid blocks belong to two dimensions.
   */
  template <int dim>
  class Solver
  {
  public:
    /**
     * Keeps a reference to @p model. @p loads: all loads of the run;
     * @p far_field and @p static_far_field: of the load of type 'boundary
     * elements', or null; the second acts in static stages.
     */
    Solver(Model<dim> &model, const std::vector<LoadParameters> &loads,
           std::unique_ptr<FarField> far_field,
           std::unique_ptr<StaticFarField> static_far_field);

    virtual ~Solver() = default;

    /** Adds the slices of its operators and constraints to @p state, of
        Model::initial_state(), before it is read from a checkpoint. */
    virtual void prepare(State<dim> &state) const;

    /**
     * Updates the internal variables of cells, joints and contacts of @p state,
     * a copy, for its configuration; in equilibrium they are up to date.
     * Collective.
     */
    virtual void update_histories(State<dim> & /*state*/)
    {
    }

    /**
     * Stops @p blocks of the whole mesh and returns the kinetic energy that
     * those of this rank had [J]. Collective.
     */
    virtual double stop_blocks(const std::vector<unsigned int> & /*blocks*/,
                               State<dim> & /*state*/)
    {
      return 0.;
    }

    /** Cuts the interfaces of liners to @p blocks, which are about to be taken
        away: Beams::cut(). Collective. */
    virtual void cut_liners(const std::vector<unsigned int> &blocks,
                            State<dim> &state);

    /** Adds the forces of the water in joints between @p blocks, which are
        about to be taken away, and others to the owned nodes of both [N]. */
    void add_water_between(const std::vector<unsigned int> &blocks,
                           const State<dim> &state,
                           dealii::Tensor<1, dim> *force) const;

    /** Throws a RunError if the motion is no longer finite, which names the
        load if one is not; collective. */
    void check_finite(const State<dim> &state) const;
    /** Energies as last computed. */
    const Energies &energies() const
    {
      return last_energies;
    }
    /** Sets @p energies, where a trial is over and its state is dropped. */
    void set_energies(const Energies &energies)
    {
      last_energies = energies;
    }

    /** All loads of the run. Beams, water and load controls may be set before
        prepare(). */
    RunLoads<dim> &loads()
    {
      return all;
    }
    const RunLoads<dim> &loads() const
    {
      return all;
    }
    /** The loads that act in the stage that has begun. */
    const StageLoads<dim> &stage_loads() const
    {
      return acting;
    }

    /** Force [N] and moment [N m] of a load; collective. */
    virtual Resultant<dim> resultant(const std::string &load) const;
    /** The forces that a platen which bears() exerts on its nodes [N]. */
    virtual std::vector<dealii::Tensor<1, dim>>
    node_forces(const MotionConstraint<dim> &platen) const
    {
      return platen.rigid_motion()->node_forces();
    }
    /** Called before a checkpoint: completes @p state. */
    virtual void save(State<dim> &state) const;
    /** Called after a checkpoint: drops what only checkpoints need. */
    virtual void discard_saved(State<dim> &state) const;

    /** Wall time of this process by phase of a step. */
    PhaseClock &time_spent()
    {
      return time_shares;
    }

  protected:
    /**
     * Switches to the loads of @p stage, which begins after @p previous; null:
     * there is none, or the stage has begun already. Throws an InputError about
     * unknown loads, bodies without support in a static stage, loads on blocks
     * that are absent in @p state, or boundaries that cannot follow the
     * materials of now.
     */
    void activate(const StageParameters &stage, const StageParameters *previous,
                  const State<dim> &state);
    /** Lets gravity that the stage names and @p previous, the stage before or
        null, does not grow over @p automatic [s], unless its parameters say
        otherwise, and with it pressures in joints and, in a stage that ends at
        rest, all other forces that begin, unless there is initial stress; loads
        of a pattern are there at once. Those that still grew at the end of the
        stage before, whose clock @p state has, go on to do so. */
    void begin_growth(const StageParameters *previous, double automatic,
                      State<dim> &state);
    /** Lets loads grow as in the stage of @p state. */
    void resume_growth(const StageParameters *previous,
                       const State<dim> &state);
    /** Growth of the water at placed blocks in the stage of @p state. */
    std::vector<GrowingWater> growing_water(const State<dim> &state) const;
    /** Begins the load pattern, if the stage has one, once the stage has
        begun; it goes on with the factor of @p previous if that has the same
        loads in its pattern. Collective. */
    void begin_pattern(const StageParameters *previous,
                       State<dim> &state) const;
    /** Sums the energies of all ranks, @p stored those that nodes and operators
        of this rank store [J]. */
    void find_energies(const State<dim> &state, EnergyAccounts stored);
    double sum(double value) const;

    Model<dim> &model;
    MPI_Comm communicator;

    RunLoads<dim> all; /**< loads of the run */
    StageParameters stage;
    StageLoads<dim> acting; /**< loads that act in this stage */
    PhaseClock time_shares;

  private:
    /** Whether the stage names @p load, but not @p previous or null. */
    bool begins(const std::string &load, const StageParameters *previous) const;
    /** Adds up @p energies of all ranks. */
    void sum_accounts(EnergyAccounts &energies) const;

    EnergyAccounts stored_at_start; /**< of all ranks */
    Energies last_energies;
  };
} // namespace quoin

#endif
