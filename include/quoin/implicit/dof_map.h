// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_dof_map_h
#define quoin_implicit_dof_map_h

#include <quoin/implicit/implicit_state.h>
#include <quoin/operators/state.h>
#include <quoin/dynamics/model.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/loads/platen.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace quoin
{
  /** A place where equilibrium is sought; what State has beside histories. */
  struct Configuration
  {
    AlignedArray<NodeRecord<2>> nodes;
    /** x, y [m] and rotation [rad] of each of DofMap::bodies(). */
    std::vector<std::array<double, 3>> bodies;
    double load_time = 0.; /**< in the stage [s] */
    double released  = 1.; /**< share of the held forces that is gone [-] */
  };

  /**
   * The degrees of freedom of a stage in equilibrium and their constraints.
   *
   * Component d of the displacement of node g of NodeMap::dof_handler() has
   * the number 2 g + d. Four for each body, a platen or a rigid block, come
   * after those of the nodes: displacement x and y of its centre, rotation,
   * and one that is always zero, so that all come in pairs.
   *
   * Nodes that a load moves and nodes of absent blocks are constrained to what
   * is given; nodes of a body follow its degrees of freedom rigidly through
   * any rotation, u = d + (R - I) r, in constraints() by their present arms:
   * du = dd + dtheta x (R r).
   */
  class DofMap
  {
  public:
    using Index       = dealii::types::global_dof_index;
    using Vector      = dealii::TrilinosWrappers::MPI::Vector;
    using Constraints = dealii::AffineConstraints<double>;

    struct Body
    {
      const MotionConstraint<2> *platen; /**< null: a rigid block */
      unsigned int rigid_block;
      double centre[2];                /**< where displacements are zero [m] */
      std::array<bool, 3> given;       /**< by functions of time */
      Index first;                     /**< of its degrees of freedom */
      std::vector<unsigned int> nodes; /**< owned ones */
      std::vector<std::array<double, 2>> arms;         /**< unrotated [m] */
      std::vector<std::array<double, 2>> present_arms; /**< rotated [m] */
      bool counts; /**< here: this rank books its work and equations */
    };

    /** A component of a node that is given by itself. */
    struct Prescribed
    {
      unsigned int node; /**< owned */
      unsigned int component;
      const LoadComponent *part; /**< of the PrescribedMotion<2> */
    };

    /**
     * @p constraints: those that act in the stage, in their order;
     * @p held: of each rigid block, whether a platen moves it. Collective.
     */
    DofMap(const Model &model,
           const std::vector<MotionConstraint<2> *> &constraints,
           const std::vector<bool> &held, const State<2> &state);

    const std::vector<Body> &bodies() const
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
    /** Owned ones, those of local nodes and of the bodies that move these. */
    const dealii::IndexSet &relevant() const
    {
      return relevant_dofs;
    }
    Index n_dofs() const
    {
      return owned_dofs.size();
    }
    /** Component @p d of a local node. */
    Index dof(const unsigned int node, const unsigned int d) const
    {
      return node_dofs[2 * node + d];
    }
    /** Writes those of @p n local nodes to @p dofs, 2 n long. */
    void get_dofs(const unsigned int *nodes, const unsigned int n,
                  std::vector<Index> &dofs) const
    {
      for (unsigned int i = 0; i < 2 * n; ++i)
        dofs[i] = node_dofs[2 * nodes[i / 2] + i % 2];
    }

    /** Of increments, as update_constraints() left them. */
    const Constraints &constraints() const
    {
      return affine;
    }
    /** Whether component @p d of a local node is a degree of freedom of its
        own. */
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

    Configuration configuration(const State<2> &state) const;
    /** Writes nodes, platens and rigid blocks; times are the caller's. */
    void write(const Configuration &configuration, State<2> &state) const;

    /** Present arms of bodies' nodes become those of @p configuration. */
    void update_arms(const Configuration &configuration);

    /**
     * The same, and constraints() are those of the increments from
     * @p configuration by which the load time goes to @p load_time: their
     * inhomogeneities are how far given motions go on the way. Collective.
     */
    void update_constraints(const Configuration &configuration,
                            double load_time);

    /**
     * Moves @p configuration by @p share of the @p increment of the degrees of
     * freedom and its load time to @p load_time, with all that is given;
     * collective.
     */
    void move(const Vector &increment, double share, double load_time,
              Configuration &configuration) const;

    /** Adds @p force on owned nodes to the degrees of freedom that move these,
        by constraints(); compress() is the caller's. */
    void add_forces(const AlignedArray<NodeVector<2>> &force,
                    Vector &right_hand_side) const;

    /** Adds what acts on bodies besides, on each rank that counts them. */
    void add_body_forces(const std::vector<std::array<double, 3>> &force,
                         Vector &right_hand_side) const;

    /** Force and moment of @p force on the nodes of each body; collective. */
    std::vector<std::array<double, 3>>
    body_forces(const AlignedArray<NodeVector<2>> &force) const;

    /** Loads of the degrees of freedom of bodies; zero for those given. */
    std::vector<std::array<double, 3>> drives(double load_time) const;

  private:
    /** What a local node's constraints are made of, told by its owner. */
    struct Tie
    {
      Index body;                   /**< its first one, or invalid */
      std::array<double, 2> motion; /**< present arm or what is given [m] */
      std::array<bool, 2> given;    /**< if there is no body */
    };

    void add_platens(const std::vector<MotionConstraint<2> *> &constraints,
                     const State<2> &state);
    void add_rigid_blocks(const std::vector<bool> &held);
    void number();
    void place(Configuration &configuration) const;
    /** How far component @p d of a driven body goes [m or rad]. */
    double given_motion(const Body &body, unsigned int d, double from,
                        double to) const;

    const Model &model;
    MPI_Comm communicator;
    const double stage_start;
    std::vector<Body> body_list; /**< platens first, on all ranks */
    unsigned int n_platens = 0;
    std::vector<Prescribed> prescribed_list;
    std::vector<bool> absent; /**< of local nodes */
    std::vector<Tie> ties;    /**< of local nodes */
    bool has_bodies = false;  /**< here or on the other side of a joint */
    std::vector<Index> node_dofs;
    dealii::IndexSet owned_dofs, relevant_dofs;
    Constraints affine;
  };

  /**
   * How far a driven component goes between two times of the stage [m or
   * degrees]: a displacement by its values, a velocity by its integral.
   */
  double given_change(const LoadComponent &component, double from, double to,
                      double stage_start);
} // namespace quoin

#endif
