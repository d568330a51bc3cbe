// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_solver_h
#define quoin_dynamics_solver_h

#include <quoin/base/phase_clock.h>
#include <quoin/operators/state.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/farfield/far_field.h>
#include <quoin/farfield/static_far_field.h>
#include <quoin/model/model.h>
#include <quoin/loading/stage_loads.h>
#include <quoin/stages/stage_parameters.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/loads/platen.h>
#include <quoin/structures/beams.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  class JointFlow;

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

  /** The two constraints of the load of type 'boundary elements'; null: there
      is none. */
  struct FarFields
  {
    /** Far field of stages that end by time. */
    FarField *elastodynamic      = nullptr;
    StaticFarField *elastostatic = nullptr; /**< far field of static stages */
    // In the stage that has begun:
    bool elastodynamic_acts = false;
    bool elastostatic_acts  = false;
  };

  /**
   * Base of all solvers: the loads of a run and those that act in the stage,
   * the energies. Platens, free fields, boundary elements and rigid blocks
   * belong to two dimensions.
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
     * a copy, for its configuration. Collective.
     */
    virtual void update_histories(State<dim> &state) = 0;

    /**
     * Stops @p blocks of the whole mesh and returns the kinetic energy that
     * those of this rank had [J]. Collective.
     */
    virtual double stop_blocks(const std::vector<unsigned int> & /*blocks*/,
                               State<dim> & /*state*/)
    {
      return 0.;
    }

    /** Lets water flow in joints; @p flow must outlive this object. */
    void set_flow(JointFlow *flow)
    {
      water = flow;
    }
    /** The water that flows in joints; null: there is none. */
    const JointFlow *flow() const
    {
      return water;
    }

    /** Sets this rank's @p terms of the displacement that the load pattern of
        the stage @p name controls, if a history gives it. */
    void set_control(const std::string &name,
                     const std::vector<DisplacementTerm> &terms)
    {
      controls[name] = terms;
    }

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

    /** The loads that act in the stage that has begun. */
    const StageLoads<dim> &stage_loads() const
    {
      return acting;
    }

    /** Force x, y [N] and moment [N m] of a load; collective. */
    virtual std::array<double, 3> resultant(const std::string &load) const;
    /** Whether @p load adds the mass of water, so that it has a resultant. */
    bool has_added_mass(const std::string &load) const
    {
      return std::count(loads_of_water.begin(), loads_of_water.end(), load) > 0;
    }

    /** Takes the beams of the run, before prepare(). */
    void set_beams(std::unique_ptr<Beams> beams)
    {
      all_beams = std::move(beams);
    }
    /** Null: there are none. */
    Beams *beams() const
    {
      return all_beams.get();
    }

    const FarFields &far_fields() const
    {
      return far;
    }

    /** Called before a checkpoint: completes @p state. */
    virtual void save(State<dim> &state) const;
    /** Called after a checkpoint: drops what only checkpoints need. */
    virtual void discard_saved(State<dim> &state) const;

    /** Null if displacements are small. */
    virtual const BlockContacts *contacts() const
    {
      return nullptr;
    }

    /** Wall time of this process by phase of a step. */
    PhaseClock &time_spent()
    {
      return time_shares;
    }

    /** Constraints of all loads, active in this stage or not. */
    const std::vector<std::unique_ptr<MotionConstraint<dim>>> &
    constraints() const
    {
      return all_constraints;
    }

  protected:
    /**
     * Switches to the loads of @p stage. Throws an InputError about unknown
     * loads, bodies without support in a static stage, or loads on blocks that
     * are absent in @p state.
     */
    void activate(const StageParameters &stage, const State<dim> &state);
    /** Lets gravity that the stage names and @p previous, the stage before or
        null, does not grow over @p automatic [s], unless its parameters say
        otherwise; loads of a pattern are there at once. */
    void ramp_gravity(const StageParameters *previous, double automatic);
    /** Begins the load pattern, if the stage has one, once the stage has
        begun; it goes on with the factor of @p previous if that has the same
        loads in its pattern. Collective. */
    void begin_pattern(const StageParameters *previous,
                       State<dim> &state) const;
    /** Refuses loads on absent blocks, except prescribed motions. */
    void refuse_absent_nodes(const State<dim> &state) const;
    /** Whether @p stage names @p constraint and, of far fields, is of its kind.
     */
    bool acts_in(const MotionConstraint<dim> &constraint,
                 const StageParameters &stage) const;
    /**
     * The rigid blocks that platens of the stage move. Throws an InputError
     * about one that is held in part or by something else.
     */
    std::vector<bool> find_held_blocks() const;
    /** Throws an InputError if two platens of the stage share a node. */
    void refuse_shared_platens() const;
    /** Sums the energies of all ranks, @p stored those that nodes and operators
        of this rank store [J]. */
    void find_energies(const State<dim> &state, EnergyAccounts stored);
    double sum(double value) const;

    Model<dim> &model;
    MPI_Comm communicator;

    std::vector<std::unique_ptr<MotionConstraint<dim>>> all_constraints;
    FarFields far; /**< two of them */
    std::vector<NodalLoad<dim>> all_loads;
    JointFlow *water = nullptr;       /**< null: no water flows in joints */
    std::unique_ptr<Beams> all_beams; /**< in two dimensions, or null */
    std::vector<std::string> known_loads;
    std::vector<std::string> loads_of_water; /**< with added mass */

    StageParameters stage;
    StageLoads<dim> acting; /**< loads that act in this stage */
    PhaseClock time_shares;

  private:
    std::map<std::string, std::vector<DisplacementTerm>>
        controls; /**< load controls by the names of stages */
    void make_free_fields(const std::vector<LoadParameters> &loads);
    /** Lets the last one of all_loads, the uplift @p load, follow cracks, if it
        does. */
    void add_uplift(const LoadParameters &load);
    void add_far_fields(std::unique_ptr<FarField> far_field,
                        std::unique_ptr<StaticFarField> static_field);

    /** Adds up @p energies of all ranks. */
    void sum_accounts(EnergyAccounts &energies) const;

    EnergyAccounts stored_at_start; /**< of all ranks */
    Energies last_energies;
  };

  // Members that exist in two dimensions only.
  template <>
  void Solver<2>::add_uplift(const LoadParameters &load);
  template <>
  void Solver<3>::add_uplift(const LoadParameters &load);
  template <>
  void Solver<2>::make_free_fields(const std::vector<LoadParameters> &loads);
  template <>
  void
  Solver<2>::add_far_fields(std::unique_ptr<FarField> far_field,
                            std::unique_ptr<StaticFarField> static_far_field);
  template <>
  std::vector<bool> Solver<2>::find_held_blocks() const;
} // namespace quoin

#endif
