// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_elements/cell_strain.h>
#include <quoin/block_elements/cell_tangent.h>
#include <quoin/block_elements/triangle_tangent.h>

namespace quoin
{
  bool linearise_cell(const BlockForcesData<2> &data, const unsigned int cell,
                      const NodeRecord<2> *nodes, PlasticHistory &history,
                      CellLinearisation &result, const bool with_stiffness)
  {
    CellPoint point           = cell_point(data, nodes, cell);
    auto gradient             = point.displacement_gradient(nodes);
    const MohrCoulomb *yields = data.law_of(cell);
    if (yields)
    {
      // The elastic part of the deformation, F (I + Q), is linear in F: another
      // element with the same forces.
      const auto &q = history.cells[cell].inverse_stretch;
      gradient      = stretched_gradient(gradient, q);
      for (unsigned int i = 0; i < point.n_nodes; ++i)
      {
        const double x = point.gradients[i][0], y = point.gradients[i][1];
        point.gradients[i] = dealii::Point<2>(x + q[0] * x + q[2] * y,
                                              y + q[2] * x + q[1] * y);
      }
    }
    const CorotatedStrain strain(gradient);
    if (point.area == 0.)
    {
      if (yields)
        update_cell(data, cell, strain.e, history);
      return false;
    }
    const double volume = data.thickness_of(cell) * point.area;
    const auto initial  = data.initial_stress_of(cell);

    PlaneTensor stress;
    PlaneTangent tangent;
    result.dissipated = 0.;
    if (yields)
    {
      if (with_stiffness)
        tangent
            = yields->tangent(plastic_point(history, cell), strain.e, initial);
      const PlasticStep step = update_cell(data, cell, strain.e, history);
      result.dissipated      = volume * step.dissipated;
      stress                 = step.stress;
    }
    else
    {
      tangent = elastic_tangent(data.stiffness_of(cell));
      stress  = elastic_stress(data.stiffness_of(cell), strain.e);
      for (unsigned int i = 0; i < 3; ++i)
        stress[i] += initial[i];
    }
    const ElementDerivatives energy(strain, stress,
                                    with_stiffness ? &tangent : nullptr);

    result.n_nodes       = point.n_nodes;
    result.nodes         = point.nodes;
    const unsigned int n = 2 * point.n_nodes;
    std::array<PlaneGradient, 12> rows;
    for (unsigned int i = 0; i < point.n_nodes; ++i)
    {
      const auto pair = node_gradients(point.gradients[i]);
      rows[2 * i]     = pair[0];
      rows[2 * i + 1] = pair[1];
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      result.force[i] = 0.;
      for (unsigned int k = 0; k < 4; ++k)
        result.force[i] -= volume * rows[i][k] * energy.first[k];
    }
    if (!with_stiffness)
      return true;
    std::array<PlaneGradient, 12> by_node;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < 4; ++k)
      {
        by_node[i][k] = 0.;
        for (unsigned int l = 0; l < 4; ++l)
          by_node[i][k] += volume * energy.second[k][l] * rows[i][l];
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        double sum = 0.;
        for (unsigned int k = 0; k < 4; ++k)
          sum += rows[i][k] * by_node[j][k];
        result.stiffness[i][j] = sum;
      }
    return true;
  }
} // namespace quoin
