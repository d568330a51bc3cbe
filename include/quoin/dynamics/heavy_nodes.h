// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_heavy_nodes_h
#define quoin_dynamics_heavy_nodes_h

#include <quoin/loads/hydrodynamic_mass.h>
#include <quoin/motions/motion_constraint.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Captured nodes that have added masses, which differ from direction to
      direction. */
  template <int dim>
  class HeavyNodes
  {
  public:
    /** Takes the masses @p added to nodes, ascending, which are among
        @p captured but for those that are @p absent (local nodes). */
    void capture(const std::vector<NodeMass<dim>> &added,
                 const std::vector<bool> &absent,
                 std::vector<CapturedNode<dim>> &captured);
    /** Moves their free components, after all that is prescribed. */
    void move(const StepContext &context,
              std::vector<CapturedNode<dim>> &captured, State<dim> &state);
    /** Force on its node by the inertia of @p mass in the last step [N]. */
    dealii::Tensor<1, dim> inertia_force(const NodeMass<dim> &mass) const;

  private:
    /** A node with an added mass. */
    struct HeavyNode
    {
      unsigned int node, captured; /**< local node, its position there */
      dealii::Tensor<2, dim> mass; /**< added mass [kg] */
      /** Inverse of all mass of the free components, 0 elsewhere [1/kg]. */
      dealii::Tensor<2, dim> inverse;
      dealii::Tensor<1, dim> acceleration; /**< in the last step [m/s^2] */
    };
    std::vector<HeavyNode> heavy; /**< ascending nodes */
  };
} // namespace quoin

#endif
