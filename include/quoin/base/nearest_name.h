// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_nearest_name_h
#define quoin_base_nearest_name_h

#include <string>
#include <vector>

namespace quoin
{
  /** Fewest letters to insert, remove or replace between @p a and @p b. */
  std::size_t edit_distance(const std::string &a, const std::string &b);

  /** @p names, those like @p wanted first. */
  std::vector<std::string> nearest_first(const std::string &wanted,
                                         std::vector<std::string> names);
} // namespace quoin

#endif
