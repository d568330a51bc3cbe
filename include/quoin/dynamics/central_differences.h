// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_central_differences_h
#define quoin_dynamics_central_differences_h

#include <quoin/base/phase_clock.h>
#include <quoin/blocks/block_forces.h>
#include <quoin/blocks/node_update.h>
#include <quoin/dynamics/stage_parameters.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  /** What a step sums over the nodes of this rank. */
  struct StepSums
  {
    DampingWork damping;
    double applied    = 0.; /**< by joints, contacts and loads [N] */
    double unbalanced = 0.; /**< [N] */
  };

  /**
   * Steps of the nodes of deformable blocks by central differences with
   * velocities at half steps (@cite JinWangZhang1998, Eqs. 4-5): the forces of
   * operators and blocks, damping, motion, and what constraints make of it.
   * The parts of a step are called one after the other, as
   * ExplicitSolver::step() does; time and what the parts have in common comes
   * in a StepContext.
   *
   * On entry of a step positions are those of t, velocities those of t - dt/2.
   */
  template <int dim>
  class CentralDifferences
  {
  public:
    /** Keeps references. */
    CentralDifferences(const NodeMap<dim> &nodes,
                       const BlockForces<dim> &blocks, PhaseClock &clock);

    // For a stage, in this order.

    /** Masses of the local nodes as they act [kg]. */
    void set_mass(const std::vector<double> &mass);
    /** What acts, in this order, and the damping of @p stage; @p begun: those
        of @p forces that did not act in the stage before. */
    void set_operators(const std::vector<ForceOperator<dim> *> &forces,
                       const std::vector<ForceOperator<dim> *> &begun,
                       const std::vector<MotionConstraint<dim> *> &constraints,
                       const StageParameters &stage);
    /** Finds the nodes that constraints move, but for those that are @p absent
        (local nodes), which stay where they are. */
    void capture_nodes(const std::vector<bool> &absent);
    /** These nodes keep their velocity, and no force acts on them. */
    void hold(const NodeRange &range);

    /** At @p state, with a step of @p dt [s]. */
    StepContext context(const State<dim> &state, double dt) const;

    // The parts of a step.

    /** Operators look for neighbours. Collective. */
    void update_neighbours(State<dim> &state, const StepContext &context);
    /** Forces of operators, and their work since the last step. Collective. */
    void add_forces(State<dim> &state, const StepContext &context);
    /** Takes velocities for kinetic_energy() and squared_change(). */
    void keep_velocities(const State<dim> &state)
    {
      velocity_before = state.velocity;
    }
    /** Forces of blocks tile by tile, and the motion of the nodes that no other
        rank shares; @p balance: with the sum of unbalanced forces. */
    void advance_tiles(State<dim> &state, const StepContext &context,
                       bool balance, StepSums &sums);
    /** Nodes of blocks that lie on several ranks. Collective. */
    void advance_shared_nodes(State<dim> &state, const StepContext &context,
                              bool balance, StepSums &sums);
    /** Those of rigid blocks that are captured. */
    void capture_rigid_blocks(const State<dim> &state);
    /** Collective. */
    void move_constrained_nodes(State<dim> &state, const StepContext &context);
    /** Work of operators and damping until the middle of the step. Collective
        with adaptive damping. */
    void book_work(State<dim> &state, const StepContext &context,
                   const StepSums &sums) const;
    /** Collective. */
    void exchange_positions(State<dim> &state);

    // What there is to know of a step.

    /** Sum of the forces of operators on this rank's nodes [N], after
        add_forces(). Collective. */
    double applied_force() const;
    /** Of the nodes of this rank at the time of the step [J], from velocities
        before and after it. */
    double kinetic_energy(const State<dim> &state,
                          const StepContext &context) const;
    /** Sum of mass times squared change of velocity in the step [J]. */
    double squared_change(const State<dim> &state) const;
    /** Unbalanced by applied force, of all ranks. Collective. */
    double unbalanced_ratio(const State<dim> &state, const StepContext &context,
                            StepSums sums) const;
    /** Recoverable energy of operators, of this rank [J]. */
    double stored_energy(const State<dim> &state) const;

    /** Of local nodes [N]; zero after a step. */
    NodeForces<dim> node_forces()
    {
      return { force.data(),
               has_viscous_forces() ? viscous_force.data() : nullptr };
    }
    NodeVector<dim> *viscous_forces()
    {
      return viscous_force.data();
    }
    const std::vector<double> &mass() const
    {
      return node_mass;
    }

  private:
    bool has_viscous_forces() const
    {
      return stage.stiffness_coefficient > 0.;
    }
    /** CapturedNode::begun of the stage's first step. */
    void find_begun_forces(const StepContext &context, State<dim> &state);
    /** Moves free nodes of @p range; @p first_captured: into captured_begin.
     */
    void advance_range(State<dim> &state, const StepContext &context,
                       bool balance, const NodeRange &range,
                       unsigned int first_captured, StepSums &sums);
    /** Adds what this rank has on shared nodes to their owners', and forgets
        it. Collective. */
    void add_shared_forces(AlignedArray<NodeVector<dim>> &values);
    void capture(CapturedNode<dim> &node, const State<dim> &state) const;
    void adapt_damping(State<dim> &state, const StepContext &context,
                       const DampingWork &work) const;

    const NodeMap<dim> &nodes;
    const NodeExchange &exchange;
    const BlockForces<dim> &blocks;
    PhaseClock &clock;

    std::vector<ForceOperator<dim> *> forces, begun;
    std::vector<MotionConstraint<dim> *> constraints;
    StageParameters stage;
    /** Phases of forces and constraints. */
    std::vector<unsigned int> force_phases, constraint_phases;
    const struct
    {
      unsigned int blocks, search, loads, exchange;
    } phases;

    std::vector<double> node_mass;    /**< local nodes [kg] */
    std::vector<double> moving_mass;  /**< zero at constrained nodes [kg] */
    std::vector<double> inverse_mass; /**< zero at constrained nodes [1/kg] */
    std::vector<NodeRange> held;

    std::vector<CapturedNode<dim>> captured; /**< ascending nodes */
    /** First entry of each tile, of shared nodes, and of rigid blocks. */
    std::vector<unsigned int> captured_begin;

    AlignedArray<NodeVector<dim>> force;
    AlignedArray<NodeVector<dim>> viscous_force;
    AlignedArray<NodeVector<dim>> velocity_before;
  };
} // namespace quoin

#endif
