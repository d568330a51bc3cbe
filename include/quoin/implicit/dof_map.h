// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_dof_map_h
#define quoin_implicit_dof_map_h

#include <quoin/implicit/rigid_bodies.h>
#include <quoin/operators/state.h>
#include <quoin/model/model.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/motions/platen.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace quoin
{
  using DofIndex  = dealii::types::global_dof_index;
  using DofVector = dealii::TrilinosWrappers::MPI::Vector;

  /**
   * The degrees of freedom of a stage in equilibrium and their constraints.
   *
   * Component d of the displacement of global node g of NodeExchange has
   * the number dim g + d. Those of each body, a platen or a rigid block, come
   * after those of the nodes. Four in two dimensions: displacement x and y of
   * its centre, rotation, and one that is always zero, so that all come in
   * pairs. Six in three: displacement and the rotations about the axes.
   *
   * The last one is the factor of a load pattern, if the stage has one.
   *
   * Nodes that a load moves and nodes of absent blocks are constrained to
   * prescribed values; nodes of a body follow its degrees of freedom rigidly
   * through any rotation, u = d + (R - I) r, in constraints() by their present
   * arms: du = dd + dtheta x (R r). In three dimensions an increment dtheta
   * turns R into exp(dtheta x) R.
   */
  template <int dim>
  class DofMap
  {
  public:
    using Constraints = dealii::AffineConstraints<double>;

    /** A component of a node prescribed by a PrescribedMotion. */
    struct Prescribed
    {
      unsigned int node; /**< owned */
      unsigned int component;
      const LoadComponent *part; /**< component of the PrescribedMotion<dim> */
    };

    /**
     * @p constraints: those that act in the stage, in their order; @p held:
     * whether a platen moves each rigid block; @p has_factor: whether the
     * stage has a load pattern. Collective.
     */
    DofMap(const Model<dim> &model,
           const std::vector<MotionConstraint<dim> *> &constraints,
           const std::vector<bool> &held, const State<dim> &state,
           bool has_factor = false);

    /** Number of the degree of freedom that is the factor of the load pattern;
        invalid without a pattern. The first rank owns it. */
    DofIndex factor() const
    {
      return factor_dof;
    }

    const RigidBodies<dim> &bodies() const
    {
      return body_list;
    }
    const std::vector<Prescribed> &prescribed() const
    {
      return prescribed_list;
    }
    const dealii::IndexSet &owned() const
    {
      return owned_dofs;
    }
    /** Owned degrees of freedom, those of local nodes and of their bodies. */
    const dealii::IndexSet &relevant() const
    {
      return relevant_dofs;
    }
    /** Degree of freedom of component @p d of a local node. */
    DofIndex dof(const unsigned int node, const unsigned int d) const
    {
      return node_dofs[dim * node + d];
    }
    /** Writes degrees of freedom of @p n local nodes to @p dofs, dim n
        long. */
    void get_dofs(const unsigned int *nodes, const unsigned int n,
                  std::vector<DofIndex> &dofs) const
    {
      for (unsigned int i = 0; i < dim * n; ++i)
        dofs[i] = node_dofs[dim * nodes[i / dim] + i % dim];
    }

    /** Constraints of increments, as of the last update_constraints(). */
    const Constraints &constraints() const
    {
      return affine;
    }
    /** Whether component @p d of a local node is unconstrained. */
    bool is_free(const unsigned int node, const unsigned int d) const
    {
      return !affine.is_constrained(dof(node, d));
    }
    /** Whether the block of a local node is absent: then it does not move. */
    bool is_absent(const unsigned int node) const
    {
      return absent[node];
    }
    /** Whether a local node follows a body. */
    bool is_in_body(const unsigned int node) const
    {
      return ties[node].body != dealii::numbers::invalid_dof_index;
    }

    /** Updates the present arms of bodies' nodes for @p configuration. */
    void update_arms(const Configuration<dim> &configuration);

    /**
     * As update_arms(), and sets constraints() of the increments from
     * @p configuration to the load time @p load_time: their inhomogeneities are
     * the increments of prescribed motions. Collective.
     */
    void update_constraints(const Configuration<dim> &configuration,
                            double load_time);

    /**
     * Moves @p configuration by @p share of the @p increment of the degrees of
     * freedom and its load time to @p load_time, with all prescribed motions;
     * collective.
     */
    void move(const DofVector &increment, double share, double load_time,
              Configuration<dim> &configuration) const;

    /** Adds @p force on owned nodes to their degrees of freedom, by
        constraints(); the caller calls compress(). */
    void add_forces(const AlignedArray<dealii::Tensor<1, dim>> &force,
                    DofVector &right_hand_side) const;

  private:
    /** Constraint of a local node, received from its owner. */
    struct Tie
    {
      DofIndex body; /**< first degree of freedom of its body, or invalid */
      dealii::Tensor<1, dim> motion; /**< present arm or displacement [m] */
      std::array<bool, dim>
          given; /**< whether prescribed, if there is no body */
    };

    static constexpr unsigned int dofs_per_body = dim == 2 ? 4 : 6;

    void add_platens(const std::vector<MotionConstraint<dim> *> &constraints,
                     const State<dim> &state);
    void add_rigid_blocks(const std::vector<bool> &held);
    void number(bool has_factor);
    /** Adds the constraints of a node of a body. */
    void add_tie(unsigned int node);
    /** Increment of component @p d of a driven body [m or rad]. */
    double given_motion(const RigidBody<dim> &body, unsigned int d, double from,
                        double to) const;

    const Model<dim> &model;
    MPI_Comm communicator;
    const double stage_start;
    RigidBodies<dim> body_list;
    unsigned int n_platens = 0;
    DofIndex factor_dof    = dealii::numbers::invalid_dof_index;
    std::vector<Prescribed> prescribed_list;
    std::vector<bool> absent; /**< flag of each local node */
    std::vector<Tie> ties;    /**< ties of local nodes */
    /** Whether this rank or the other side of a joint has bodies. */
    bool has_bodies = false;
    std::vector<DofIndex> node_dofs;
    dealii::IndexSet owned_dofs, relevant_dofs;
    Constraints affine;
  };

  // Rigid blocks belong to two dimensions.
  template <>
  void DofMap<2>::add_rigid_blocks(const std::vector<bool> &);

  /**
   * Increment of a driven component between two times of the stage [m or
   * degrees]: of a displacement the difference, of a velocity the integral. The
   * @p place counts if it differs from place to place.
   */
  template <int dim>
  double given_change(const LoadComponent &component, double from, double to,
                      double stage_start, const dealii::Point<dim> &place = {});
} // namespace quoin

#endif
