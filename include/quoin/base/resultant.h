// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_resultant_h
#define quoin_base_resultant_h

#include <deal.II/base/tensor.h>

#include <array>

namespace quoin
{
  /** Number of motions of a rigid body: along the axes, and rotations. */
  template <int dim>
  constexpr unsigned int n_body_motions = dim *(dim + 1) / 2;

  /** Force along the axes [N], then the moment [N m]: in two dimensions the one
      in the plane, anticlockwise, in three about each axis. */
  template <int dim>
  using Resultant = std::array<double, n_body_motions<dim>>;

  /** Adds @p force [N] and its moment with @p arm [m] to @p resultant. */
  template <int dim>
  void add_force(const dealii::Tensor<1, dim> &force,
                 const dealii::Tensor<1, dim> &arm, Resultant<dim> &resultant)
  {
    for (unsigned int d = 0; d < dim; ++d)
      resultant[d] += force[d];
    if constexpr (dim == 2)
      resultant[2] += arm[0] * force[1] - arm[1] * force[0];
    else
    {
      const dealii::Tensor<1, 3> moment = dealii::cross_product_3d(arm, force);
      for (unsigned int d = 0; d < 3; ++d)
        resultant[3 + d] += moment[d];
    }
  }
} // namespace quoin

#endif
