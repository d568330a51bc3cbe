// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_rigid_bodies_h
#define quoin_implicit_rigid_bodies_h

#include <quoin/implicit/implicit_state.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/operators/state.h>

#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace quoin
{
  /** A platen or a rigid block in equilibrium; see DofMap. */
  struct RigidBody
  {
    const MotionConstraint<2> *platen; /**< null: a rigid block */
    unsigned int rigid_block;
    dealii::Tensor<1, 2> centre; /**< centre at zero displacement [m] */
    std::array<bool, 3> given;   /**< prescribed by functions of time */
    /** First of its degrees of freedom. */
    dealii::types::global_dof_index first;
    std::vector<unsigned int> nodes;                /**< owned ones */
    std::vector<dealii::Tensor<1, 2>> arms;         /**< unrotated [m] */
    std::vector<dealii::Tensor<1, 2>> present_arms; /**< rotated [m] */
    bool counts; /**< whether this rank books its work and equations */
  };

  /** Platens, which are on all ranks, then the rigid blocks of this rank. */
  using RigidBodies = std::vector<RigidBody>;

  /** Force x, y [N] and moment [N m], or motion, of each body. */
  using BodyValues = std::vector<std::array<double, 3>>;

  /** A configuration of the model: State without internal variables. */
  struct Configuration
  {
    AlignedArray<NodeRecord<2>> nodes;
    BodyValues bodies;     /**< x, y [m] and rotation [rad] */
    double load_time = 0.; /**< load time in the stage [s] */
    double released  = 1.; /**< released share of the held forces [-] */
    double factor    = 0.; /**< load factor of the load pattern [-] */
  };

  Configuration configuration_of(const RigidBodies &bodies,
                                 const State<2> &state);
  /** Writes the motion of nodes, platens and rigid blocks, but no times. */
  void write_configuration(const RigidBodies &bodies,
                           const Configuration &configuration, State<2> &state);
  /** Places the nodes of this rank by the motion of their bodies. */
  void place_nodes(const RigidBodies &bodies, Configuration &configuration);

  /** Sums the @p values of platens over all ranks. */
  void sum_of_platens(const RigidBodies &bodies, BodyValues &values,
                      MPI_Comm communicator);

  /** Force and moment of @p force on the nodes of each body, about its centre
      with its present arms; collective. */
  BodyValues body_forces(const RigidBodies &bodies,
                         const AlignedArray<dealii::Tensor<1, 2>> &force,
                         MPI_Comm communicator);

  /** Loads on bodies [N, N m]; zero for prescribed components. */
  BodyValues body_loads(const RigidBodies &bodies, const TimePoint &time);

  /** Component @p d of the force that @p state, which has held forces, holds
      on body @p b [N, N m]. */
  double held_force(const RigidBodies &bodies, const ImplicitState &state,
                    unsigned int b, unsigned int d);

  /** Adds forces and moments on bodies to their degrees of freedom, on each
      rank that counts them. */
  void add_body_forces(const RigidBodies &bodies, const BodyValues &force,
                       dealii::TrilinosWrappers::MPI::Vector &right_hand_side);
} // namespace quoin

#endif
