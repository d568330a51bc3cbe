// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_node_record_h
#define quoin_base_node_record_h

#include <quoin/base/aligned_array.h>

#include <deal.II/base/point.h>

namespace quoin
{
  /**
   * One node of a block: reference position X and displacement u [m]; the
   * current position is X + u. They are kept together, in two dimensions in 32
   * bytes, because the block kernel always loads both.
   */
  template <int dim>
  struct alignas(dim == 2 ? 32 : 16) NodeRecord
  {
    dealii::Point<dim> X;
    dealii::Tensor<1, dim> u;

    /** Current position [m]. */
    dealii::Point<dim> position() const
    {
      return X + u;
    }
  };
} // namespace quoin

#endif
