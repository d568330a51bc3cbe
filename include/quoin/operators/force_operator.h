// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_force_operator_h
#define quoin_operators_force_operator_h

#include <quoin/operators/state.h>
#include <quoin/operators/step_context.h>

namespace quoin
{
  /** Forces on the local nodes of a rank, to which operators add theirs. */
  template <int dim>
  struct NodeForces
  {
    NodeVector<dim> *force; /**< [N] */
    /** Forces of stiffness-proportional damping [N]; null: there is none. */
    NodeVector<dim> *viscous;
  };

  /**
   * A force on nodes that follows from their positions and velocities and from
   * time: blocks, joints, contacts, loads. Operators are called once a step,
   * never once a point.
   *
   * Motion that is not a node's own is a MotionConstraint.
   */
  template <int dim>
  class ForceOperator
  {
  public:
    virtual ~ForceOperator() = default;

    /** Under this name its share of the time is reported. */
    virtual const char *kind() const = 0;

    /** Adds its own slices to @p state, unless they are there. */
    virtual void prepare(State<dim> &) const
    {
    }

    /**
     * Takes the positions at the start of the step: searches neighbours, where
     * there is something to search. Collective.
     */
    virtual void update(const StepContext &, State<dim> &)
    {
    }

    /**
     * Updates its internal variables for the positions at the start of the
     * step, books what that dissipates in State::energy, and adds its forces.
     * Collective.
     */
    virtual void add_forces(const StepContext &step, State<dim> &state,
                            const NodeForces<dim> &forces)
        = 0;

    /** Recoverable energy of this rank's share [J], after add_forces(). */
    virtual double stored_energy(const State<dim> &) const
    {
      return 0.;
    }

    /** Rate [W] at which it does work from outside on nodes that move with
        @p velocity. */
    virtual double external_power(const TimePoint &,
                                  const NodeVector<dim> * /*velocity*/) const
    {
      return 0.;
    }
  };
} // namespace quoin

#endif
