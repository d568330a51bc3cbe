// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_packed_vectors_h
#define quoin_base_packed_vectors_h

#include <deal.II/base/point.h>

#include <cstddef>

/**
 * Vectors in the plane or in space, packed one after the other in an array of
 * numbers (an Eigen vector, a std::vector, a pointer): component d of vector k
 * is entry dim k + d.
 */
namespace quoin
{
  /** Vector @p k of @p values. */
  template <int dim = 2, typename Values>
  dealii::Tensor<1, dim> vector_at(const Values &values, const std::size_t k)
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = values[dim * k + d];
    return result;
  }

  /** Sets vector @p k of @p values. */
  template <int dim, typename Values>
  void set_vector(Values &values, const std::size_t k,
                  const dealii::Tensor<1, dim> &vector)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[dim * k + d] = vector[d];
  }

  /** Adds to vector @p k of @p values. */
  template <int dim, typename Values>
  void add_to_vector(Values &values, const std::size_t k,
                     const dealii::Tensor<1, dim> &vector)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values[dim * k + d] += vector[d];
  }

  /** Appends a vector to @p values. */
  template <int dim, typename Values>
  void append_vector(Values &values, const dealii::Tensor<1, dim> &vector)
  {
    for (unsigned int d = 0; d < dim; ++d)
      values.push_back(vector[d]);
  }
} // namespace quoin

#endif
