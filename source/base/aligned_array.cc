// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/aligned_array.h>

#include <new>

#include <sys/mman.h>

namespace quoin
{
  namespace
  {
    constexpr std::size_t huge_page = 2097152;

    bool is_large(const std::size_t bytes)
    {
      return bytes >= 2 * huge_page;
    }
    std::align_val_t alignment(const std::size_t bytes)
    {
      return std::align_val_t(is_large(bytes) ? huge_page : 64);
    }
  } // namespace

  void *allocate_aligned(const std::size_t bytes)
  {
    void *memory = ::operator new(bytes, alignment(bytes));
#ifdef MADV_HUGEPAGE
    // Advice that is not taken does no harm.
    if (is_large(bytes))
      madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return memory;
  }

  void free_aligned(void *memory, const std::size_t bytes)
  {
    ::operator delete(memory, alignment(bytes));
  }
} // namespace quoin
