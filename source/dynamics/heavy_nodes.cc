// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/heavy_nodes.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Inverse of the rows and columns of @p matrix, positive definite, that
        are @p free; 0 elsewhere. */
    template <int dim>
    dealii::Tensor<2, dim> inverse_of_free(dealii::Tensor<2, dim> matrix,
                                           const std::array<bool, dim> &free)
    {
      dealii::Tensor<2, dim> inverse;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
        {
          inverse[d][e] = d == e;
          if (!free[d] || !free[e])
            matrix[d][e] = d == e;
        }
      // Gauss and Jordan; no pivots are needed.
      for (unsigned int k = 0; k < dim; ++k)
      {
        const double pivot = matrix[k][k];
        for (unsigned int e = 0; e < dim; ++e)
        {
          matrix[k][e] /= pivot;
          inverse[k][e] /= pivot;
        }
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double factor = matrix[d][k];
          for (unsigned int e = 0; e < dim && d != k; ++e)
          {
            matrix[d][e] -= factor * matrix[k][e];
            inverse[d][e] -= factor * inverse[k][e];
          }
        }
      }
      for (unsigned int d = 0; d < dim; ++d)
        if (!free[d])
          inverse[d][d] = 0.;
      return inverse;
    }
  } // namespace

  template <int dim>
  void HeavyNodes<dim>::capture(const std::vector<NodeMass<dim>> &added,
                                const std::vector<bool> &absent,
                                std::vector<CapturedNode<dim>> &captured)
  {
    heavy.clear();
    for (const NodeMass<dim> &each : added)
    {
      if (absent[each.node])
        continue;
      HeavyNode node{};
      node.node = each.node;
      node.captured
          = std::lower_bound(
                captured.begin(), captured.end(), each.node,
                [](const CapturedNode<dim> &other, const unsigned int number)
                { return other.node < number; })
            - captured.begin();
      CapturedNode<dim> &moving  = captured[node.captured];
      moving.has_added_mass      = true;
      node.mass                  = each.mass;
      dealii::Tensor<2, dim> all = each.mass;
      std::array<bool, dim> free;
      for (unsigned int d = 0; d < dim; ++d)
      {
        all[d][d] += moving.mass;
        free[d] = !moving.owner[d];
      }
      node.inverse = inverse_of_free<dim>(all, free);
      heavy.push_back(node);
    }
  }

  template <int dim>
  void HeavyNodes<dim>::move(const StepContext &context,
                             std::vector<CapturedNode<dim>> &captured,
                             State<dim> &state)
  {
    const double h = context.dt_velocity, a = 0.5 * h * context.mass_damping;
    for (HeavyNode &each : heavy)
    {
      CapturedNode<dim> &node         = captured[each.captured];
      dealii::Tensor<1, dim> &v1      = state.velocity[node.node];
      const dealii::Tensor<1, dim> v0 = node.velocity;
      // Prescribed components accelerate the water, too.
      dealii::Tensor<1, dim> force = node.force;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          if (node.owner[e])
            force[d] -= each.mass[d][e] * (v1[e] - v0[e]) / h;
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (node.owner[d])
          continue;
        double acceleration = 0.;
        for (unsigned int e = 0; e < dim; ++e)
          acceleration += each.inverse[d][e] * force[e];
        v1[d] = (1. - a) / (1. + a) * v0[d] + h / (1. + a) * acceleration;
        state.nodes[node.node].u[d] = node.displacement[d] + context.dt * v1[d];
      }
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
        {
          if (node.owner[d] || node.owner[e])
            continue;
          const double mass = each.mass[d][e] + (d == e ? node.mass : 0.);
          const double drag
              = -0.5 * context.mass_damping * mass * (v0[e] + v1[e]);
          state.energy.damping -= 0.5 * context.dt_before * drag * v0[d];
          state.pending.damping -= 0.5 * context.dt * drag * v1[d];
        }
      each.acceleration = (v1 - v0) / h;
      node.force -= each.mass * each.acceleration;
    }
  }

  template <int dim>
  dealii::Tensor<1, dim>
  HeavyNodes<dim>::inertia_force(const NodeMass<dim> &mass) const
  {
    const auto found
        = std::lower_bound(heavy.begin(), heavy.end(), mass.node,
                           [](const HeavyNode &each, const unsigned int node)
                           { return each.node < node; });
    if (found == heavy.end() || found->node != mass.node)
      return {};
    return -(mass.mass * found->acceleration);
  }

  template class HeavyNodes<2>;
  template class HeavyNodes<3>;
} // namespace quoin
