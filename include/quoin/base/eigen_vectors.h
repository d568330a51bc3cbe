// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_eigen_vectors_h
#define quoin_base_eigen_vectors_h

#include <quoin/base/eigen_core.h>

#include <deal.II/base/point.h>

namespace quoin
{
  /** The matrix a b^T. */
  inline Eigen::Matrix2d dyad(const dealii::Tensor<1, 2> &a,
                              const dealii::Tensor<1, 2> &b)
  {
    Eigen::Matrix2d result;
    result << a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1];
    return result;
  }

  /** @p vector as a factor of Eigen's matrices. */
  inline Eigen::Vector2d to_eigen(const dealii::Tensor<1, 2> &vector)
  {
    return { vector[0], vector[1] };
  }

  /** Result of a product with Eigen's matrices as a vector. */
  template <typename Derived>
  dealii::Tensor<1, 2> to_tensor(const Eigen::MatrixBase<Derived> &expression)
  {
    const Eigen::Vector2d result = expression;
    return dealii::Point<2>(result[0], result[1]);
  }
} // namespace quoin

#endif
