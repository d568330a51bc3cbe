// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_elements/cell_strain.h>

namespace quoin
{
  std::array<double, 4>
  CellPoint::displacement_gradient(const NodeRecord<2> *records) const
  {
    // Differences keep the digits of strains under large motions.
    const dealii::Tensor<1, 2> origin = records[nodes[0]].u;
    std::array<double, 4> H{};
    for (unsigned int i = 1; i < n_nodes; ++i)
    {
      const dealii::Tensor<2, 2> part
          = outer_product(records[nodes[i]].u - origin, gradients[i]);
      for (unsigned int k = 0; k < 4; ++k)
        H[k] += part[k / 2][k % 2];
    }
    return H;
  }

  CellPoint cell_point(const BlockForcesData<2> &data,
                       const NodeRecord<2> *nodes, const unsigned int cell)
  {
    std::array<unsigned int, 3> corners = data.cells[cell];
    const unsigned int first = cell & ~3U; // first cell of a quadratic triangle
    if (data.quadratic)
      for (unsigned int i = 0; i < 3; ++i)
        corners[i] = data.cells[first + i][0];
    const auto [a, b, c] = corners;
    const Triangle triangle(nodes[a], nodes[b], nodes[c]);
    CellPoint point;
    point.n_nodes    = 3;
    point.nodes      = { { a, b, c } };
    const double det = triangle.det;
    point.gradients[1]
        = dealii::Point<2>(triangle.e2[1] / det, -triangle.e2[0] / det);
    point.gradients[2]
        = dealii::Point<2>(-triangle.e1[1] / det, triangle.e1[0] / det);
    point.gradients[0] = -point.gradients[1] - point.gradients[2];
    point.area         = triangle.area();
    if (!data.quadratic)
      return point;

    // The centroids of the three outer cells are the integration points of the
    // rule of second order; the inner cell is for output.
    const bool is_inner = cell == first + 3;
    std::array<double, 3> lambda;
    lambda.fill(is_inner ? 1. / 3. : 1. / 6.);
    if (!is_inner)
      lambda[cell - first] = 2. / 3.;
    point.area = is_inner ? 0. : triangle.area() / 3.;
    const std::array<dealii::Tensor<1, 2>, 3> linear
        = { { point.gradients[0], point.gradients[1], point.gradients[2] } };
    point.n_nodes = 6;
    for (unsigned int i = 0; i < 3; ++i)
    {
      const unsigned int j = (i + 1) % 3;
      point.nodes[3 + i]   = data.cells[first + 3][i]; // between i and j
      point.gradients[i]   = (4. * lambda[i] - 1.) * linear[i];
      point.gradients[3 + i]
          = 4. * (lambda[i] * linear[j] + lambda[j] * linear[i]);
    }
    return point;
  }

  std::array<double, 4> cell_gradient(const BlockForcesData<2> &data,
                                      const NodeRecord<2> *nodes,
                                      const std::size_t cell, double *area)
  {
    if (data.quadratic)
    {
      const CellPoint point = cell_point(data, nodes, cell);
      if (area)
        *area = point.area;
      return point.displacement_gradient(nodes);
    }
    const auto [a, b, c] = data.cells[cell];
    const Triangle triangle(nodes[a], nodes[b], nodes[c]);
    if (area)
      *area = triangle.area();
    return triangle.gradient(nodes[a].u, nodes[b].u, nodes[c].u);
  }

  PlasticStep update_cell(const BlockForcesData<2> &data,
                          const std::size_t cell, const PlaneTensor &strain,
                          PlasticHistory &history)
  {
    PlasticPoint point     = plastic_point(history, cell);
    const PlasticStep step = data.law_of(cell)->update(
        point, strain, data.initial_stress_of(cell));
    set_plastic_point(point, cell, history);
    return step;
  }
} // namespace quoin
