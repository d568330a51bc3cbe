// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_central_differences_h
#define quoin_dynamics_central_differences_h

#include <quoin/base/phase_clock.h>
#include <quoin/blocks/block_forces.h>
#include <quoin/blocks/node_update.h>
#include <quoin/dynamics/heavy_nodes.h>
#include <quoin/stages/stage_parameters.h>
#include <quoin/loads/hydrodynamic_mass.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  /** Sums of a step over the nodes of this rank. */
  struct StepSums
  {
    DampingWork damping;
    double applied    = 0.; /**< forces of joints, contacts and loads [N] */
    double unbalanced = 0.; /**< [N] */
  };

  /** The context of a step of @p dt [s] from @p state in @p stage. */
  template <int dim>
  StepContext step_context(const State<dim> &state,
                           const StageParameters &stage, double dt);

  /**
   * Steps of the nodes of deformable blocks by central differences with
   * velocities at half steps (@cite JinWangZhang1998, Eqs. 4-5): forces of
   * operators and blocks, damping, update of velocities and displacements,
   * constraints. ExplicitSolver::step() calls the parts of a step one after the
   * other; they share a StepContext.
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

    /** Sets operators, in order of action, and the damping of @p stage;
        @p begun: those of @p forces that did not act in the previous stage. */
    void set_operators(const std::vector<ForceOperator<dim> *> &forces,
                       const std::vector<ForceOperator<dim> *> &begun,
                       const std::vector<MotionConstraint<dim> *> &constraints,
                       const StageParameters &stage);
    /** Whether forces have dashpots beside the damping of the stage. */
    void use_dashpots(const bool are_used)
    {
      dashpots = are_used;
    }
    /** Takes the masses of the local nodes, with mass scaling [kg], and finds
        the nodes that constraints move, but for those that are @p absent (local
        nodes), which stay where they are; @p added: of nodes that have more
        mass in some directions, ascending. */
    void capture_nodes(const std::vector<double> &mass,
                       const std::vector<NodeMass<dim>> &added,
                       const std::vector<bool> &absent);
    /** Makes @p nodes keep their velocity; no force acts on them. */
    void hold(const std::vector<unsigned int> &nodes);

    // The parts of a step.

    /** Operators search for contacts. Collective. */
    void update_neighbours(State<dim> &state, const StepContext &context);
    /** Adds forces of operators and books their last work. Collective. */
    void add_forces(State<dim> &state, const StepContext &context);
    /** Adds the forces of blocks and moves their nodes; @p balance: also sums
        the unbalanced forces. Collective. */
    void advance_blocks(State<dim> &state, const StepContext &context,
                        bool balance, StepSums &sums);
    /** Captures the constrained nodes of rigid blocks; returns the forces on
        all local nodes, for RigidBlocks::advance(). */
    NodeForces<dim> capture_rigid_blocks(const State<dim> &state);
    /** Collective. */
    void move_constrained_nodes(State<dim> &state, const StepContext &context);
    /** Books the work of operators and damping until the middle of the step.
        Collective with adaptive damping. */
    void book_work(State<dim> &state, const StepContext &context,
                   const StepSums &sums);
    /** Collective. */
    void exchange_positions(State<dim> &state);

    // Sums of a step.

    /** Sum of the forces of operators on this rank's nodes [N], after
        add_forces(). Collective. */
    double applied_force() const;
    /** Ratio of unbalanced to applied force, of all ranks [-], or to a
        thousandth of the largest applied force of the stage where less is left:
        without loads both go to zero. Counts that of now in @p state if it is
        to be @p kept. Collective. */
    double unbalanced_ratio(State<dim> &state, const StepContext &context,
                            StepSums sums, bool kept) const;
    /** Force on @p node by the inertia of @p mass in the last step [N]. */
    dealii::Tensor<1, dim> inertia_force(const NodeMass<dim> &mass) const
    {
      return heavy.inertia_force(mass);
    }
    /** Adds the recoverable energy of operators, of this rank. */
    void add_stored_energy(const State<dim> &state,
                           EnergyAccounts &energies) const;

  private:
    bool has_viscous_forces() const
    {
      return stage.stiffness_coefficient > 0. || dashpots;
    }
    /** Finds CapturedNode::begun in the stage's first step. */
    void find_begun_forces(const StepContext &context, State<dim> &state);
    /** Adds the forces of blocks tile by tile and moves the nodes that no other
        rank shares, while forces on shared nodes are exchanged. */
    void advance_tiles(State<dim> &state, const StepContext &context,
                       bool balance, StepSums &sums);
    /** Moves the nodes of blocks that lie on several ranks. Collective. */
    void advance_shared_nodes(State<dim> &state, const StepContext &context,
                              bool balance, StepSums &sums);
    /** Moves free nodes of @p range; @p first_captured: into captured_begin.
     */
    void advance_range(State<dim> &state, const StepContext &context,
                       bool balance, const NodeRange &range,
                       unsigned int first_captured, StepSums &sums);
    void advance_tile(unsigned int tile, State<dim> &state,
                      const StepContext &context, bool balance, StepSums &sums);
    /** Waits until other ranks' forces are added to those of shared nodes that
        this rank owns, and clears those of nodes that it does not own. */
    void finish_sum(OwnerSum<dealii::Tensor<1, dim>> &sum,
                    AlignedArray<dealii::Tensor<1, dim>> &values);
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
    bool dashpots = false;
    /** Clock phases of forces and constraints. */
    std::vector<unsigned int> force_phases, constraint_phases;
    /** External power of forces in the middle of the last step, with its forces
        [W]; none after a change of velocities between steps. */
    std::vector<double> last_power;
    TimePoint last_begin;
    const struct
    {
      unsigned int blocks, search, loads, exchange;
    } phases;

    /** Tiles whose cells have shared nodes, then the others. */
    std::vector<unsigned int> tiles;
    unsigned int n_tiles_at_others = 0; /**< tiles that have shared nodes */

    std::vector<double> moving_mass;  /**< zero at constrained nodes [kg] */
    std::vector<double> inverse_mass; /**< zero at constrained nodes [1/kg] */
    std::vector<unsigned int> held;   /**< ascending */

    std::vector<CapturedNode<dim>> captured; /**< ascending nodes */
    HeavyNodes<dim> heavy;
    /** First entry of each tile, of shared nodes, and of rigid blocks. */
    std::vector<unsigned int> captured_begin;

    /** Forces on the local nodes [N]; zero after a step. */
    AlignedArray<dealii::Tensor<1, dim>> force, viscous_force;
    OwnerSum<dealii::Tensor<1, dim>> force_sum, viscous_sum;
  };
} // namespace quoin

#endif
