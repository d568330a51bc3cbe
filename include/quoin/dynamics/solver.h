// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_solver_h
#define quoin_dynamics_solver_h

#include <quoin/base/phase_clock.h>
#include <quoin/operators/state.h>
#include <quoin/farfield/far_field.h>
#include <quoin/farfield/static_far_field.h>
#include <quoin/dynamics/free_bodies.h>
#include <quoin/dynamics/model.h>
#include <quoin/dynamics/release.h>
#include <quoin/dynamics/stage_parameters.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/loads/platen.h>

#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /** Energies of the whole model at one time [J]. */
  struct Energies
  {
    double kinetic   = 0.;
    double strain    = 0.; /**< of the blocks, since the start */
    double joint     = 0.; /**< recoverable, since the start */
    double far_field = 0.; /**< of static boundary elements, since then */
    EnergyAccounts accounts;

    /** What the balance leaves over; zero but for rounding and kinks. */
    double residual() const
    {
      return stored() + accounts.sum(EnergyKind::dissipated)
             - accounts.sum(EnergyKind::given);
    }

    /** What the model could give back. */
    double stored() const
    {
      return kinetic + strain + joint + far_field;
    }

    /** All energy that went through the model, to judge the residual by. */
    double throughput() const;
  };

  /**
   * What all solvers share: the loads of a run, which of them act in the
   * stage, the energies, and looks at whether the state is sound.
   */
  class Solver
  {
  public:
    /**
     * Keeps a reference to @p model. @p loads: all loads of the run;
     * @p far_field and @p static_far_field: of the load that is of the type
     * 'boundary elements', or null; the second acts in static stages.
     */
    Solver(Model &model, const std::vector<LoadParameters> &loads,
           std::unique_ptr<FarField> far_field,
           std::unique_ptr<StaticFarField> static_far_field);

    virtual ~Solver() = default;

    /** Adds the slices of its operators and constraints to @p state, of
        Model::initial_state(), before it is read from a checkpoint. */
    virtual void prepare(State<2> &state) const;

    /**
     * Brings the histories of cells, joints and contacts of @p state, a copy,
     * to its positions. Collective.
     */
    virtual void update_histories(State<2> &state) = 0;

    /**
     * Takes the motion off @p blocks of this rank and returns the energy that
     * they had by it [J].
     */
    virtual double stop_blocks(const std::vector<unsigned int> & /*blocks*/,
                               State<2> & /*state*/)
    {
      return 0.;
    }

    /** Throws a RunError if the state is no longer finite; collective. */
    void check_finite(const State<2> &state) const;
    /** The same, and names the load, if one that acts is not finite at
        @p load_time [s] of the stage. */
    void check_loads(const State<2> &state, double load_time) const;
    /**
     * The largest slip of a matched joint that bears pressure, by the length of
     * its face: beyond a half or so its blocks no longer face each other, and
     * small displacements do not hold. Collective.
     */
    double largest_slip_share(const State<2> &state) const;

    /** The same if a cell has turned inside out; collective. */
    void check_cells(const State<2> &state) const;

    /** As last computed. */
    const Energies &energies() const
    {
      return last_energies;
    }
    /**
     * Whether loads have changed in the last @p duration of the stage [s], or
     * will: a static stage is not over before they rest. The future is looked
     * at where each time is a tenth later than the one before: a shorter pulse
     * may be missed.
     */
    bool loads_change(const State<2> &state, double duration) const;

    /** Throws an InputError about loads that would begin with a jump. */
    void check_start(const State<2> &state) const;

    /**
     * Bodies that the loads of the stage that has begun with @p state push
     * where nothing holds them; see find_pushed_bodies().
     */
    std::vector<PushedBody> pushed_bodies(const State<2> &state) const;

    /** Force x, y [N] and moment [N m] of a load; collective. */
    virtual std::array<double, 3> resultant(const std::string &load) const;

    /** Null if there is none. */
    FarField *far_field() const
    {
      return far;
    }
    /** Whether it acts in the stage that has begun. */
    bool far_field_acts() const;

    /** Null if there is none. */
    const StaticFarField *static_far_field() const
    {
      return static_far;
    }
    /** Whether that acts in the stage that has begun. */
    bool static_far_field_acts() const;

    /** Called before a checkpoint: completes @p state. */
    virtual void save(State<2> &state) const;
    /** Called after it: drops what only checkpoints need. */
    virtual void discard_saved(State<2> &state) const;

    /** Null if displacements are small. */
    virtual const BlockContacts *contacts() const
    {
      return nullptr;
    }

    /** How the steps of this process share their time. */
    PhaseClock &time_spent()
    {
      return time_shares;
    }

    /** Of all loads, acting in this stage or not. */
    const std::vector<std::unique_ptr<MotionConstraint<2>>> &constraints() const
    {
      return all_constraints;
    }

  protected:
    /**
     * Switches to the loads of @p stage. Throws an InputError about unknown
     * loads, bodies that a static stage would let drift, or loads on blocks
     * that are absent in @p state.
     */
    void activate(const StageParameters &stage, const State<2> &state);
    /** Of the loads in constraints_on, all but prescribed motions. */
    void refuse_absent_nodes(const State<2> &state) const;
    /** Whether @p stage names it and, of far fields, is of its kind. */
    bool acts_in(const MotionConstraint<2> &constraint,
                 const StageParameters &stage) const;
    /**
     * The rigid blocks that platens of the stage move. Throws an InputError
     * about one that is held in part or by something else.
     */
    std::vector<bool> find_held_blocks() const;
    /** Throws an InputError if two platens of the stage share a node. */
    void refuse_shared_platens() const;
    /** Sums the energies of all ranks; those given are this rank's [J]. */
    void find_energies(const State<2> &state, double strain, double joint,
                       double kinetic);
    double sum(double value) const;
    /** Of all loads of the stage, at a time of its own clock [s]. */
    std::vector<std::array<double, 4>> load_values(double stage_start,
                                                   double load_time) const;

    Model &model;
    MPI_Comm communicator;

    std::vector<std::unique_ptr<MotionConstraint<2>>> all_constraints;
    FarField *far              = nullptr; /**< one of them */
    StaticFarField *static_far = nullptr; /**< one of them */
    std::vector<NodalLoad<2>> all_loads;
    std::vector<std::string> known_loads;

    std::vector<MotionConstraint<2> *>
        constraints_on; /**< in order of action */
    std::vector<const NodalLoad<2> *> loads_on;
    StageParameters stage;
    Release release; /**< of what was excavated */
    PhaseClock time_shares;

  private:
    void make_free_fields(const std::vector<LoadParameters> &loads);

    double strain_at_start = 0., joint_at_start = 0.;
    Energies last_energies;
  };

  /** Whether @p stage names the load @p name. */
  bool names_load(const StageParameters &stage, const std::string &name);
} // namespace quoin

#endif
