// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_none_h
#define quoin_base_none_h

#include <deal.II/base/types.h>

namespace quoin
{
  /** The index of no node, edge, cell or block. */
  inline constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
} // namespace quoin

#endif
