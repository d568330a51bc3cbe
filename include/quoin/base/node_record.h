// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_node_record_h
#define quoin_base_node_record_h

#include <deal.II/base/point.h>

#include <cstddef>
#include <new>
#include <vector>

namespace quoin
{
  /** Allocator of 64-byte aligned arrays for vector loads. */
  template <typename T>
  struct CacheAlignedAllocator
  {
    using value_type        = T;
    CacheAlignedAllocator() = default;
    template <typename U>
    CacheAlignedAllocator(const CacheAlignedAllocator<U> &)
    {
    }
    T *allocate(const std::size_t n)
    {
      return static_cast<T *>(
          ::operator new(n * sizeof(T), std::align_val_t(64)));
    }
    void deallocate(T *p, std::size_t)
    {
      ::operator delete(p, std::align_val_t(64));
    }
    template <typename U>
    bool operator==(const CacheAlignedAllocator<U> &) const
    {
      return true;
    }
    template <typename U>
    bool operator!=(const CacheAlignedAllocator<U> &) const
    {
      return false;
    }
  };

  template <typename T>
  using AlignedArray = std::vector<T, CacheAlignedAllocator<T>>;

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
