// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_freedoms_h
#define quoin_implicit_freedoms_h

#include <quoin/implicit/implicit_state.h>
#include <quoin/operators/state.h>
#include <quoin/dynamics/model.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/loads/platen.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace quoin
{
  /** A place where equilibrium is sought; what State has beside histories. */
  struct Configuration
  {
    AlignedArray<NodeRecord<2>> nodes;
    /** x, y [m] and rotation [rad] of each of Freedoms::bodies(). */
    std::vector<std::array<double, 3>> bodies;
    double load_time = 0.; /**< in the stage [s] */
    double released  = 1.; /**< share of the held forces that is gone [-] */
  };

  /**
   * The unknowns of equilibrium in a stage: displacements of nodes that
   * nothing moves, and three freedoms of each body, a platen or a rigid
   * block, whose nodes follow it rigidly through any rotation.
   *
   * Unknowns have global numbers: 2 g + d for component d of the global node
   * g, whether it is free or not, and four for each body after those of the
   * nodes, the fourth unused, so that they come in pairs. Rows of what is not
   * free are those of the unit matrix.
   */
  class Freedoms
  {
  public:
    using Index                    = dealii::types::global_dof_index;
    using Vector                   = dealii::TrilinosWrappers::MPI::Vector;
    static constexpr Index nothing = -1;

    struct Body
    {
      const MotionConstraint<2> *platen; /**< null: a rigid block */
      unsigned int rigid_block;
      double centre[2];                /**< where displacements are zero [m] */
      std::array<bool, 3> given;       /**< by functions of time */
      Index first;                     /**< of its unknowns */
      std::vector<unsigned int> nodes; /**< owned ones */
      std::vector<double> arms;        /**< x, y of each, unrotated [m] */
      bool counts; /**< here: this rank books its work and equations */
    };

    /** How the displacement of a local node follows from the unknowns. */
    struct Node
    {
      Index unknown[3]; /**< for x, for y and for both, by the arm */
      double arm[2];    /**< from the centre of its body, as it is now [m] */
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
     * @p held: of each rigid block, whether a platen moves it.
     */
    Freedoms(const Model &model,
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
      return owned_unknowns;
    }
    Index n_unknowns() const
    {
      return owned_unknowns.size();
    }
    /** Of all local nodes, with the arms of update_arms(). */
    const std::vector<Node> &nodes() const
    {
      return node_list;
    }
    /** Whether component @p d of an owned node is an unknown of its own. */
    bool is_free(const unsigned int node, const unsigned int d) const
    {
      return node_list[node].unknown[d] != nothing
             && node_list[node].unknown[2] == nothing && !in_body[node];
    }
    /** Whether the block of a local node is absent: then it does not move. */
    bool is_absent(const unsigned int node) const
    {
      return absent[node];
    }
    bool is_in_body(const unsigned int node) const
    {
      return in_body[node];
    }

    Configuration configuration(const State<2> &state) const;
    /** Writes nodes, platens and rigid blocks; times are the caller's. */
    void write(const Configuration &configuration, State<2> &state) const;

    /** Arms of bodies' nodes become those of @p configuration; collective. */
    void update_arms(const Configuration &configuration);

    /**
     * How far given motions go as the load time goes from that of
     * @p configuration to @p load_time: of every local node, by its arm;
     * collective.
     */
    AlignedArray<NodeVector<2>> given_motion(const Configuration &configuration,
                                             double load_time,
                                             double stage_start) const;

    /**
     * Moves @p configuration by @p share of the @p increment of the unknowns
     * and its load time to @p load_time, with all that is given; collective.
     */
    void move(const Vector &increment, double share, double load_time,
              double stage_start, Configuration &configuration) const;

    /**
     * Sums @p force on owned nodes to @p right_hand_side, zero where nothing is
     * free; @p body_force: what acts on bodies besides, on each rank that
     * counts it. Collective.
     */
    void project(const AlignedArray<NodeVector<2>> &force,
                 const std::vector<std::array<double, 3>> &body_force,
                 Vector &right_hand_side) const;

    /** Force and moment of @p force on the nodes of each body; collective. */
    std::vector<std::array<double, 3>>
    body_forces(const AlignedArray<NodeVector<2>> &force) const;

    /** Loads of the freedoms of bodies at a time; zero for those given. */
    std::vector<std::array<double, 3>> drives(double load_time,
                                              double stage_start) const;

  private:
    void add_platens(const std::vector<MotionConstraint<2> *> &constraints,
                     const State<2> &state);
    void add_rigid_blocks(const std::vector<bool> &held);
    void number();
    void place(Configuration &configuration) const;

    const Model &model;
    MPI_Comm communicator;
    std::vector<Body> body_list; /**< platens first, on all ranks */
    unsigned int n_platens = 0;
    std::vector<Prescribed> prescribed_list;
    std::vector<Node> node_list;
    std::vector<std::uint8_t> in_body; /**< of owned nodes */
    std::vector<bool> absent;          /**< of local nodes */
    dealii::IndexSet owned_unknowns;
  };

  /**
   * How far a driven component goes between two times of the stage [m or
   * degrees]: a displacement by its values, a velocity by its integral.
   */
  double given_change(const LoadComponent &component, double from, double to,
                      double stage_start);
} // namespace quoin

#endif
