// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_aligned_array_h
#define quoin_base_aligned_array_h

#include <cstddef>
#include <vector>

namespace quoin
{
  /**
   * Memory of that many @p bytes for arrays of numbers, aligned to 64 bytes,
   * for vector loads. Large arrays ask the system for huge pages, where it
   * gives these to those who ask alone: a step goes through all of them, and of
   * small pages there are more than the processor keeps addresses of.
   */
  void *allocate_aligned(std::size_t bytes);
  /** Gives back what allocate_aligned() gave for that many @p bytes. */
  void free_aligned(void *memory, std::size_t bytes);

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
      return static_cast<T *>(allocate_aligned(n * sizeof(T)));
    }
    void deallocate(T *p, const std::size_t n)
    {
      free_aligned(p, n * sizeof(T));
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
} // namespace quoin

#endif
