// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/kinetic_energy.h>

namespace quoin
{
  template <int dim>
  double kinetic_energy(const NodeMap<dim> &nodes,
                        const std::vector<double> &mass,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after,
                        const double share)
  {
    double kinetic = 0.;
    for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double v = before[i][d];
        kinetic += 0.5 * mass[i] * v * (v + share * (after[i][d] - v));
      }
    return kinetic;
  }

  template <int dim>
  double kinetic_energy(const std::vector<NodeMass<dim>> &masses,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after,
                        const double share)
  {
    double kinetic = 0.;
    for (const auto &[i, mass] : masses)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
        {
          const double v = before[i][e];
          kinetic += 0.5 * before[i][d] * mass[d][e]
                     * (v + share * (after[i][e] - v));
        }
    return kinetic;
  }

  template <int dim>
  double squared_change(const std::vector<NodeMass<dim>> &masses,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after)
  {
    double sum = 0.;
    for (const auto &[i, mass] : masses)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          sum += (after[i][d] - before[i][d]) * mass[d][e]
                 * (after[i][e] - before[i][e]);
    return sum;
  }

  template <int dim>
  double squared_change(const NodeMap<dim> &nodes,
                        const std::vector<double> &mass,
                        const AlignedArray<dealii::Tensor<1, dim>> &before,
                        const AlignedArray<dealii::Tensor<1, dim>> &after)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double change = after[i][d] - before[i][d];
        sum += mass[i] * change * change;
      }
    return sum;
  }

  template double kinetic_energy(const NodeMap<2> &,
                                 const std::vector<double> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &,
                                 double);
  template double kinetic_energy(const std::vector<NodeMass<2>> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &,
                                 double);
  template double squared_change(const std::vector<NodeMass<2>> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &);
  template double kinetic_energy(const std::vector<NodeMass<3>> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &,
                                 double);
  template double squared_change(const std::vector<NodeMass<3>> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &);
  template double squared_change(const NodeMap<2> &,
                                 const std::vector<double> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &,
                                 const AlignedArray<dealii::Tensor<1, 2>> &);
  template double kinetic_energy(const NodeMap<3> &,
                                 const std::vector<double> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &,
                                 double);
  template double squared_change(const NodeMap<3> &,
                                 const std::vector<double> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &,
                                 const AlignedArray<dealii::Tensor<1, 3>> &);
} // namespace quoin
