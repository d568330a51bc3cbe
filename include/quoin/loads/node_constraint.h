// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_node_constraint_h
#define quoin_loads_node_constraint_h

#include <quoin/base/state.h>
#include <quoin/loads/time_function.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  class NodeConstraint;

  /**
   * A node whose motion is not its own: what it had at the start of the step,
   * that is the force at t before local and mass damping, the velocity at
   * t - dt/2 and the displacement at t.
   */
  struct CapturedNode
  {
    unsigned int node;          /**< local */
    double mass;                /**< [kg] */
    NodeVector<2> force;        /**< [N] */
    NodeVector<2> velocity;     /**< [m/s] */
    NodeVector<2> displacement; /**< [m] */
    NodeVector<2> viscous; /**< stiffness-proportional part of the force [N] */
    /**
     * Part of the force at the first step of a stage: of tractions and gravity
     * that did not act in the stage before, if there was one [N].
     */
    NodeVector<2> begun;
    /** What moves each component: the last to act on it; null: nothing. */
    const NodeConstraint *owner[2];
  };

  /** Moment about the origin [N m] of @p force [N] on a node, as it was at t.
   */
  inline double moment_of(const double *force, const CapturedNode &before,
                          const NodeRecord<2> &node)
  {
    return (node.X[0] + before.displacement.v[0]) * force[1]
           - (node.X[1] + before.displacement.v[1]) * force[0];
  }

  /** The step under way, from t to t + dt. */
  struct StepContext
  {
    TimePoint begin, middle, end; /**< by the loads' clock */
    double load_rate;             /**< of that clock [-] */
    double dt;                    /**< from t to t + dt [s] */
    double dt_before;             /**< of the step before; 0 at the first [s] */
    double dt_velocity;           /**< from middle to middle [s] */
    double local_damping;         /**< Cundall's factor; 0: none */
    double mass_damping;          /**< alpha [1/s] */
    double stiffness_damping;     /**< beta [s] */
  };

  /**
   * Moves nodes in another way than by their own force. The solver advances
   * all nodes as if free; then correct() overwrites velocity and displacement
   * of the constrained ones, and account() books the work that this took.
   */
  class NodeConstraint
  {
  public:
    virtual ~NodeConstraint() = default;

    /** Local nodes that this rank owns, ascending. */
    const std::vector<unsigned int> &nodes() const
    {
      return node_list;
    }

    const std::string &name() const
    {
      return load_name;
    }

    /** Position of each of nodes() in the solver's list of captured nodes. */
    void bind(std::vector<unsigned int> positions)
    {
      captured_positions = std::move(positions);
    }

    /** Its functions of time: what they are now, to see whether they rest. */
    virtual std::array<double, 3> values(const TimePoint &time) const = 0;

    /**
     * Throws an InputError if a displacement is not zero where the stage
     * begins: it would be a jump.
     */
    virtual void check_start(const TimePoint &) const
    {
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

    /** Called when a stage begins in which it does not act. */
    void rest()
    {
      last_resultant = {};
    }

    /** Called when a stage begins; @p continues: it acted in the last one. */
    virtual void begin_stage(State<2> &, const bool /*continues*/)
    {
    }

    /** Called instead when a run is resumed within a stage. */
    virtual void resume_stage(const State<2> &)
    {
    }

    /** Called before a checkpoint: what is not in the state goes there. */
    virtual void save(State<2> &) const
    {
    }

    virtual void correct(const StepContext &step,
                         const std::vector<CapturedNode> &captured,
                         State<2> &state)
        = 0;

    virtual void account(const StepContext &step,
                         const std::vector<CapturedNode> &captured,
                         State<2> &state)
        = 0;

    /**
     * Force x, y [N] and moment about the origin or, for a platen, its centre
     * [N m] on the nodes at the start of the last step; summed over ranks by
     * the caller unless is_global().
     */
    std::array<double, 3> resultant() const
    {
      return last_resultant;
    }

    /** Whether it moves both components of its nodes, prescribed or not. */
    virtual bool moves_all() const
    {
      return true;
    }

    virtual bool is_global() const
    {
      return false;
    }

    /** Unbalanced force [N] of freedoms that the constraint itself moves. */
    virtual double unbalanced() const
    {
      return 0.;
    }

    /** Which freedoms (x, y and, of platens, rotation) it prescribes. */
    virtual std::array<bool, 3> holds() const = 0;

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
