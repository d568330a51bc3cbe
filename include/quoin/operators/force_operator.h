// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_force_operator_h
#define quoin_operators_force_operator_h

#include <quoin/operators/state.h>
#include <quoin/operators/step_context.h>

#include <array>
#include <functional>
#include <vector>

namespace quoin
{
  /** Forces on the local nodes of a rank, to which operators add theirs. */
  template <int dim>
  struct NodeForces
  {
    dealii::Tensor<1, dim> *force; /**< [N] */
    /** Forces of stiffness-proportional damping [N]; null: there is none. */
    dealii::Tensor<1, dim> *viscous;
  };

  /**
   * Forces of an element on its nodes and their derivatives by the nodes'
   * displacements. Entry dim i + d of its arrays is node i, component d.
   */
  template <int dim>
  struct ElementLinearisation
  {
    const unsigned int *nodes; /**< local */
    unsigned int n_nodes;
    const double *force; /**< [N] */
    /** Minus the derivative of the forces [N/m], in rows of row_length; only if
        requested. */
    const double *stiffness;
    unsigned int row_length;
    double share = 1.; /**< share of the derivatives that this rank adds */

    // What joints add for following an equilibrium path.

    /** Area times the increment of inelastic opening and slip, negative on
        reversal [m^3], and its derivative [m^2], only if requested. */
    double inelastic                 = 0.;
    const double *inelastic_gradient = nullptr;
    unsigned int set                 = 0;  /**< of joints */
    double area                      = 0.; /**< of the joint [m^2] */
  };

  /** Takes the elements of ForceOperator::linearise(). */
  template <int dim>
  using TakeElement = std::function<void(const ElementLinearisation<dim> &)>;

  /** Weight of node a by that of node b; see add_stiffness_bound(). */
  using NodeRatio = std::function<double(unsigned int, unsigned int)>;

  /** Symmetric matrix of a node [N/m]: xx, yy, xy or xx, yy, zz, xy, xz, yz. */
  template <int dim>
  using NodeStiffness = std::array<double, dim *(dim + 1) / 2>;

  /** What bounds dashpots between blocks, for StableTimeStep. */
  struct DampingBound
  {
    /** Sum of the dashpots at each owned node; one between two nodes counts
        twice at each [N s/m]. */
    std::vector<double> dashpot;
    /** Damping of each block of the mesh, as a share of the critical one [-].
     */
    std::vector<double> share;
  };

  /**
   * A force on nodes that follows from their positions and velocities and from
   * time: blocks, joints, contacts, loads. Operators are called once a step,
   * never once a point.
   *
   * Prescribed or otherwise constrained motion is a MotionConstraint.
   */
  template <int dim>
  class ForceOperator
  {
  public:
    virtual ~ForceOperator() = default;

    /** Name under which its wall time is reported. */
    virtual const char *kind() const = 0;

    /** Adds its own slices to @p state, unless they are there. */
    virtual void prepare(State<dim> &) const
    {
    }

    /**
     * Called with the positions at the start of the step: searches contacts, if
     * there is anything to search. Collective.
     */
    virtual void update(const StepContext &, State<dim> &)
    {
    }

    /**
     * Updates its internal variables for the positions at the start of the
     * step, books the dissipation in State::energy, and adds its forces; those
     * of add_loads(), unless an operator has others. Collective.
     */
    virtual void add_forces(const StepContext &step, State<dim> & /*state*/,
                            const NodeForces<dim> &forces)
    {
      add_loads(step.begin, forces.force);
    }

    /** Adds its forces at @p time [N] if they follow from time alone. */
    virtual void add_loads(const TimePoint & /*time*/,
                           dealii::Tensor<1, dim> * /*force*/) const
    {
    }

    /**
     * Passes its elements at the positions of @p state to @p take, for implicit
     * solvers, updates its internal variables there, and books the dissipation
     * in State::energy. Does nothing if forces follow from time alone.
     */
    virtual void linearise(State<dim> & /*state*/, bool /*with_stiffness*/,
                           const TakeElement<dim> & /*take*/) const
    {
    }

    /** Whether its forces are internal ones of blocks: all others count as
        applied to blocks in ratios of the unbalanced force. */
    virtual bool is_internal() const
    {
      return false;
    }

    /**
     * Adds its share of StableTimeStep's bound to @p stiffness of the local
     * nodes. A spring k between nodes a and b adds (1 + r) k to that of a and
     * (1 + 1/r) k to that of b, with r = @p ratio (a, b) and 1/r = @p ratio
     * (b, a): the bound holds with any r > 0 and is closest where r is that of
     * the masses, m_a / m_b.
     */
    virtual void
    add_stiffness_bound(const State<dim> &, const NodeRatio & /*ratio*/,
                        std::vector<NodeStiffness<dim>> & /*stiffness*/) const
    {
    }

    /**
     * Adds the dashpots of deformable nodes and of blocks, as large as they
     * may become, with @p masses of the pairs of blocks (see
     * dashpot_masses()) and the largest wave @p impedance of blocks
     * [Pa s/m]. Collective.
     */
    virtual void add_damping_bound(const std::vector<double> & /*masses*/,
                                   double /*impedance*/,
                                   DampingBound & /*bound*/) const
    {
    }

    /** Adds its recoverable energy, of this rank's share after add_forces(), to
        its account [J]. */
    virtual void add_stored_energy(const State<dim> &,
                                   EnergyAccounts & /*energies*/) const
    {
    }

    /** Power [W] of external work on nodes that move with @p velocity. */
    virtual double
    external_power(const TimePoint &,
                   const dealii::Tensor<1, dim> * /*velocity*/) const
    {
      return 0.;
    }

    /** Whether external_power() is the same at two times of a stage if the
        velocities are; false where to find that out takes as long. */
    virtual bool has_same_power(const TimePoint &, const TimePoint &) const
    {
      return false;
    }
  };
} // namespace quoin

#endif
