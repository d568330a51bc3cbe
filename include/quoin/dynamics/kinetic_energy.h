// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_kinetic_energy_h
#define quoin_dynamics_kinetic_energy_h

#include <quoin/base/node_record.h>
#include <quoin/loads/hydrodynamic_mass.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  /**
   * Kinetic energy [J] of the nodes of deformable blocks on this rank,
   * 1/2 v m w, where w is @p share of the way from the velocities @p before to
   * those of @p after [m/s]; @p mass of nodes [kg].
   */
  template <int dim>
  double kinetic_energy(const NodeMap<dim> &nodes,
                        const std::vector<double> &mass,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after,
                        double share);

  /** Kinetic energy of the added @p masses alone [J]; arguments as above. */
  template <int dim>
  double kinetic_energy(const std::vector<NodeMass<dim>> &masses,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after,
                        double share);

  /** Sum over these nodes of mass times squared change of velocity [J]. */
  template <int dim>
  double squared_change(const NodeMap<dim> &nodes,
                        const std::vector<double> &mass,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after);
  /** Sum of the added @p masses times squared change of velocity [J]. */
  template <int dim>
  double squared_change(const std::vector<NodeMass<dim>> &masses,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after);
} // namespace quoin

#endif
