// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_motions_motion_constraint_h
#define quoin_motions_motion_constraint_h

#include <quoin/base/resultant.h>
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
   * A constrained node at the start of the step: the force at t before local
   * and mass damping, the velocity at t - dt/2 and the displacement at t.
   */
  template <int dim>
  struct CapturedNode
  {
    unsigned int node;                   /**< local */
    double mass;                         /**< [kg] */
    dealii::Tensor<1, dim> force;        /**< [N] */
    dealii::Tensor<1, dim> velocity;     /**< [m/s] */
    dealii::Tensor<1, dim> displacement; /**< [m] */
    dealii::Tensor<1, dim>
        viscous; /**< stiffness-proportional part of the force [N] */
    /**
     * Part of the force at the first step of a stage: that of tractions and
     * gravity that did not act in the previous stage, if there was one [N].
     */
    dealii::Tensor<1, dim> begun;
    /** The last constraint to act on each component; null: none. */
    const MotionConstraint<dim> *owner[dim];
    /** Whether it has a NodeMass beside its mass. Its part of the inertia then
        goes into 'force' before constraints book their work. */
    bool has_added_mass;
  };

  /** Place of a node [m] as it was at t. */
  template <int dim>
  dealii::Tensor<1, dim> place_before(const CapturedNode<dim> &before,
                                      const NodeRecord<dim> &node)
  {
    return node.X + before.displacement;
  }

  /**
   * How a constraint moves its nodes. Where several have a node, the last kind
   * prevails: prescribed motion over dashpots, a rigid body over both, because
   * it moves all of its nodes. In a step those that absorb act last, on the
   * components that are theirs: their dashpots need the velocities of the
   * others.
   */
  enum class MotionKind
  {
    absorbing,  /**< viscous and free-field boundaries, boundary elements */
    prescribed, /**< some components of each node, as functions of time */
    rigid_body  /**< all nodes together; results are those of all ranks */
  };

  /** Properties of a constraint in all stages. */
  struct ConstraintTraits
  {
    MotionKind kind = MotionKind::absorbing;
    /** Flags of the components x, y and, for platens, rotation that it
     * prescribes; in three dimensions x, y and z. */
    std::array<bool, 3> holds{};
    /** Whether it prescribes all rotations of a platen. */
    bool holds_rotation = false;
    /** Whether a stiffness resists motion of its nodes, prescribed or not. */
    bool supports = false;
    /** Name under which its wall time is reported. */
    const char *phase = "loads";
    /** The load without which it cannot act in a stage; empty: none. */
    std::string companion;
    /** Largest omega^2 of its own degrees of freedom [1/s^2]. */
    double largest_eigenvalue = 0.;

    bool is_rigid_body() const
    {
      return kind == MotionKind::rigid_body;
    }
    /** Whether it determines component @p d of the motion of its nodes. */
    bool moves(const unsigned int d) const
    {
      return kind != MotionKind::prescribed || holds[d];
    }
  };

  /** What a constraint that is a rigid body has beside. */
  template <int dim>
  class RigidMotion
  {
  public:
    /** Displacement x, y [m] and rotation [rad] since it first acted; in three
        dimensions x, y, z and the rotations about these. */
    virtual const double *displacement(const State<dim> &state) const = 0;
    /** Unbalanced force [N] of its degrees of freedom. */
    virtual double unbalanced() const = 0;
    /** In three dimensions: the functions of time of its rotations; null: none.
     */
    virtual const std::array<LoadComponent, 3> *rotations() const
    {
      return nullptr;
    }
    /** Share of its forces that acts at the @p load_time [s] of a stage in
        which they grow, see MotionConstraint::grow_forces() [-]. */
    virtual double force_share(double load_time) const = 0;
    /** Whether it is loaded or driven and moves the nodes of a boundary, which
        a plate could only press. */
    virtual bool bears() const = 0;
    /** Then: the outward normal of the boundary at its nodes, times each one's
        share of the area, where they are now [m^2]. */
    virtual std::vector<dealii::Tensor<1, dim>>
    normals(const State<dim> &state) const = 0;
    /** Then: the forces that it exerted on its nodes in the last explicit step
        [N]. */
    virtual const std::vector<dealii::Tensor<1, dim>> &node_forces() const = 0;

  protected:
    ~RigidMotion() = default;
  };

  /**
   * Prescribes or modifies the motion of nodes. The solver advances all nodes
   * as if free; then correct() overwrites velocity and displacement of the
   * constrained ones, or, if it absorbs, of their components that it owns, and
   * account() books the work done.
   */
  template <int dim>
  class MotionConstraint
  {
  public:
    virtual ~MotionConstraint() = default;

    const ConstraintTraits &traits() const
    {
      return own_traits;
    }

    /** Local nodes that this rank owns, ascending. */
    const std::vector<unsigned int> &nodes() const
    {
      return node_list;
    }

    /** Name of the load and of its slice of the state. */
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

    /**
     * Sets the masses of the local nodes in the coming stage, with mass scaling
     * [kg]. @p extra_inertia [kg m^2] is the moment of inertia of rigid blocks
     * less that of the lumped masses of their nodes, @p extra_spin [kg m^2/s]
     * the angular momentum that belongs to it.
     */
    virtual void set_mass(const std::vector<double> & /*mass*/,
                          double /*extra_inertia*/ = 0.,
                          double /*extra_spin*/    = 0.)
    {
    }

    /** The functions of time by which it drives or loads its nodes; null: none.
     */
    virtual const std::array<LoadComponent, 3> *parts() const
    {
      return nullptr;
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

    /** Lets forces that it has as functions of time grow in the stage. */
    virtual void grow_forces(const Growth & /*growth*/)
    {
    }

    /** Called instead when a run is resumed within a stage. */
    virtual void resume_stage(const State<dim> &)
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
     * Force [N] and moment [N m] about the origin or, for a platen, its centre
     * on the nodes at the start of the last step; summed over ranks by the
     * caller unless it is a rigid body.
     */
    Resultant<dim> resultant() const
    {
      return last_resultant;
    }

    /** Null: not a rigid body. */
    virtual const RigidMotion<dim> *rigid_motion() const
    {
      return nullptr;
    }

  protected:
    /** Moves the components of a node that it owns by @p velocity [m/s]. */
    void move_own(const StepContext &step, const CapturedNode<dim> &before,
                  const dealii::Tensor<1, dim> &velocity,
                  State<dim> &state) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (before.owner[d] == this)
        {
          state.velocity[before.node][d] = velocity[d];
          state.nodes[before.node].u[d]
              = before.displacement[d] + step.dt * velocity[d];
        }
    }

    ConstraintTraits own_traits;
    std::string load_name;
    std::vector<unsigned int> node_list;
    std::vector<unsigned int> captured_positions;
    Resultant<dim> last_resultant{};
  };
} // namespace quoin

#endif
