// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_finite_numbers_h
#define quoin_base_finite_numbers_h

#include <string>
#include <vector>

namespace quoin
{
  /** The numbers in @p words; empty if one of them is not a finite number. */
  std::vector<double> finite_numbers(const std::vector<std::string> &words);
} // namespace quoin

#endif
