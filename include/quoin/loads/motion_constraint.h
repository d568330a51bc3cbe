// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_motion_constraint_h
#define quoin_loads_motion_constraint_h

#include <quoin/loads/load_parameters.h>
#include <quoin/operators/state.h>
#include <quoin/operators/step_context.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  template <int dim>
  class MotionConstraint;

  /**
   * A node whose motion is not its own: what it had at the start of the step,
   * that is the force at t before local and mass damping, the velocity at
   * t - dt/2 and the displacement at t.
   */
  template <int dim>
  struct CapturedNode
  {
    unsigned int node;            /**< local */
    double mass;                  /**< [kg] */
    NodeVector<dim> force;        /**< [N] */
    NodeVector<dim> velocity;     /**< [m/s] */
    NodeVector<dim> displacement; /**< [m] */
    NodeVector<dim>
        viscous; /**< stiffness-proportional part of the force [N] */
    /**
     * Part of the force at the first step of a stage: of tractions and gravity
     * that did not act in the stage before, if there was one [N].
     */
    NodeVector<dim> begun;
    /** What moves each component: the last to act on it; null: nothing. */
    const MotionConstraint<dim> *owner[dim];
  };

  /** Moment about the origin [N m] of @p force [N] on a node, as it was at t.
   */
  inline double moment_of(const double *force, const CapturedNode<2> &before,
                          const NodeRecord<2> &node)
  {
    return (node.X[0] + before.displacement.v[0]) * force[1]
           - (node.X[1] + before.displacement.v[1]) * force[0];
  }

  /**
   * How a constraint moves its nodes. Constraints act in this order: what is
   * prescribed prevails over dashpots, a rigid body over both, because it moves
   * all of its nodes.
   */
  enum class MotionKind
  {
    absorbing,  /**< dashpots, columns and rock beyond a boundary */
    prescribed, /**< some components of each node, as functions of time */
    rigid_body  /**< all nodes together; its figures are those of all ranks */
  };

  /**
   * Moves nodes in another way than by their own force. The solver advances
   * all nodes as if free; then correct() overwrites velocity and displacement
   * of the constrained ones, and account() books the work that this took.
   */
  template <int dim>
  class MotionConstraint
  {
  public:
    virtual ~MotionConstraint() = default;

    virtual MotionKind kind() const = 0;

    /** Under this name its share of the time is reported. */
    virtual const char *phase() const
    {
      return "loads";
    }

    /** Local nodes that this rank owns, ascending. */
    const std::vector<unsigned int> &nodes() const
    {
      return node_list;
    }

    /** The load that it is; also the name of its slice of the state. */
    const std::string &name() const
    {
      return load_name;
    }

    /** Adds its slice to @p state, unless it is there. */
    virtual void prepare(State<dim> &) const
    {
    }

    /** Position of each of nodes() in the solver's list of captured nodes. */
    void bind(std::vector<unsigned int> positions)
    {
      captured_positions = std::move(positions);
    }

    /** Its functions of time: what they are now, to see whether they rest. */
    virtual std::array<double, 3> values(const TimePoint &time) const = 0;

    /** The functions of time by which it drives or loads what it moves; null:
        there are none. */
    virtual const std::array<LoadComponent, 3> *parts() const
    {
      return nullptr;
    }

    /**
     * Throws an InputError if a displacement is not zero where the stage
     * begins: it would be a jump.
     */
    virtual void check_start(const TimePoint &time) const
    {
      if (parts())
        check_no_jump(*parts(), time, load_name);
    }

    /** The load without which it cannot act in a stage; empty: none. */
    virtual std::string companion() const
    {
      return {};
    }

    /** Largest squared frequency of what it moves besides nodes [1/s^2]. */
    virtual double largest_eigenvalue() const
    {
      return 0.;
    }

    /**
     * Masses of the local nodes, as they act in the stage to come [kg]. Rigid
     * blocks are no masses at nodes: @p extra_inertia [kg m^2] is what their
     * moments of inertia have beyond those of the masses of their nodes,
     * @p extra_spin [kg m^2/s] the angular momentum that goes with it.
     */
    virtual void set_mass(const std::vector<double> & /*mass*/,
                          double /*extra_inertia*/ = 0.,
                          double /*extra_spin*/    = 0.)
    {
    }

    /** Called when a stage begins in which it does not act. */
    virtual void rest(State<dim> &)
    {
      last_resultant = {};
    }

    /** Called when a stage begins; @p continues: it acted in the last one. */
    virtual void begin_stage(State<dim> &, const bool /*continues*/)
    {
    }

    /** Called instead when a run is resumed within a stage. */
    virtual void resume_stage(const State<dim> &)
    {
    }

    /** Called before a checkpoint: what is not in the state goes there. */
    virtual void save(State<dim> &) const
    {
    }

    virtual void correct(const StepContext &step,
                         const std::vector<CapturedNode<dim>> &captured,
                         State<dim> &state)
        = 0;

    virtual void account(const StepContext &step,
                         const std::vector<CapturedNode<dim>> &captured,
                         State<dim> &state)
        = 0;

    /**
     * Force x, y [N] and moment about the origin or, for a platen, its centre
     * [N m] on the nodes at the start of the last step; summed over ranks by
     * the caller unless it is a rigid body.
     */
    std::array<double, 3> resultant() const
    {
      return last_resultant;
    }

    /** Displacement x, y [m] and rotation [rad] of a rigid body since it took
        hold; null: it is none. */
    virtual const double *rigid_displacement(const State<dim> &) const
    {
      return nullptr;
    }

    /** Whether it moves all components of its nodes, prescribed or not. */
    bool moves_all() const
    {
      return kind() != MotionKind::prescribed;
    }

    bool is_rigid_body() const
    {
      return kind() == MotionKind::rigid_body;
    }

    /** Unbalanced force [N] of the degrees of freedom of a rigid body. */
    virtual double unbalanced() const
    {
      return 0.;
    }

    /** Which of x, y and, for platens, rotation it prescribes. */
    virtual std::array<bool, 3> holds() const
    {
      return {};
    }

    /** Whether a stiffness resists motion of its nodes, given or not. */
    virtual bool supports() const
    {
      return false;
    }

  protected:
    std::string load_name;
    std::vector<unsigned int> node_list;
    std::vector<unsigned int> captured_positions;
    std::array<double, 3> last_resultant{};
  };
} // namespace quoin

#endif
