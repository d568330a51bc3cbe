// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_rigid_bodies_h
#define quoin_implicit_rigid_bodies_h

#include <quoin/implicit/implicit_state.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/operators/state.h>

#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace quoin
{
  /** A platen or a rigid block in equilibrium; see DofMap. In three dimensions
      there are platens alone. */
  template <int dim>
  struct RigidBody
  {
    const MotionConstraint<dim> *platen; /**< null: a rigid block */
    unsigned int rigid_block;
    dealii::Tensor<1, dim> centre; /**< centre at zero displacement [m] */
    /** Which of its motions functions of time prescribe. */
    std::array<bool, n_body_motions<dim>> given;
    /** First of its degrees of freedom. */
    dealii::types::global_dof_index first;
    std::vector<unsigned int> nodes;                  /**< owned ones */
    std::vector<dealii::Tensor<1, dim>> arms;         /**< unrotated [m] */
    std::vector<dealii::Tensor<1, dim>> present_arms; /**< rotated [m] */
    /** Largest component of an unrotated arm, of those of all ranks [m]. */
    double reach = 0.;
    bool counts; /**< whether this rank books its work and equations */
  };

  /** Platens, which are on all ranks, then the rigid blocks of this rank. */
  template <int dim>
  using RigidBodies = std::vector<RigidBody<dim>>;

  /** Force x, y [N] and moment [N m], or motion, of each body; in three
      dimensions x, y, z, and about these axes. */
  template <int dim>
  using BodyValues = std::vector<std::array<double, n_body_motions<dim>>>;

  /** A configuration of the model: State without internal variables. */
  template <int dim>
  struct Configuration
  {
    AlignedArray<NodeRecord<dim>> nodes;
    /** Displacements [m] and rotation [rad]; in three dimensions the integrals
        of the rates of rotation. */
    BodyValues<dim> bodies;
    /** Rotations of bodies in three dimensions since they first acted. */
    std::vector<dealii::Tensor<2, 3>> turned;
    double load_time = 0.; /**< load time in the stage [s] */
    double released  = 1.; /**< released share of the held forces [-] */
    double factor    = 0.; /**< load factor of the load pattern [-] */
  };

  template <int dim>
  Configuration<dim> configuration_of(const RigidBodies<dim> &bodies,
                                      const State<dim> &state);
  /** Writes the motion of nodes, platens and rigid blocks, but no times. */
  template <int dim>
  void write_configuration(const RigidBodies<dim> &bodies,
                           const Configuration<dim> &configuration,
                           State<dim> &state);
  /** The function of time, or load, of motion @p d of a platen. */
  template <int dim>
  const LoadComponent &body_component(const MotionConstraint<dim> &platen,
                                      unsigned int d);

  /** Places the nodes of this rank by the motion of their bodies. */
  template <int dim>
  void place_nodes(const RigidBodies<dim> &bodies,
                   Configuration<dim> &configuration);

  /** Sums the @p values of platens over all ranks. */
  template <int dim>
  void sum_of_platens(const RigidBodies<dim> &bodies, BodyValues<dim> &values,
                      MPI_Comm communicator);

  /** Force and moment of @p force on the nodes of each body, about its centre
      with its present arms; collective. */
  template <int dim>
  BodyValues<dim> body_forces(const RigidBodies<dim> &bodies,
                              const AlignedArray<dealii::Tensor<1, dim>> &force,
                              MPI_Comm communicator);

  /** Loads on bodies [N, N m]; zero for prescribed components. */
  template <int dim>
  BodyValues<dim> body_loads(const RigidBodies<dim> &bodies,
                             const TimePoint &time);

  /** Values of bodies as ImplicitState keeps them, of all @p platens and of
      the rigid @p blocks of this rank: those of body @p b. */
  template <int dim>
  std::array<double, n_body_motions<dim>>
  kept_values(const RigidBodies<dim> &bodies, unsigned int b,
              const std::vector<double> &platens,
              const std::vector<double> &blocks);
  /** Keeps the @p values of bodies so, of @p n_blocks rigid blocks. */
  template <int dim>
  void keep_values(const RigidBodies<dim> &bodies,
                   const BodyValues<dim> &values, unsigned int n_blocks,
                   std::vector<double> &platens, std::vector<double> &blocks);

  /** Adds forces and moments on bodies to their degrees of freedom, on each
      rank that counts them. */
  template <int dim>
  void add_body_forces(const RigidBodies<dim> &bodies,
                       const BodyValues<dim> &force,
                       dealii::TrilinosWrappers::MPI::Vector &right_hand_side);
} // namespace quoin

#endif
