// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_nearest_name_h
#define quoin_base_nearest_name_h

#include <quoin/base/known_names.h>

#include <string>
#include <vector>

namespace quoin
{
  /** Fewest letters to insert, remove or replace between @p a and @p b. */
  std::size_t edit_distance(const std::string &a, const std::string &b);

  /** @p names, those like @p wanted first. */
  std::vector<std::string> nearest_first(const std::string &wanted,
                                         std::vector<std::string> names);

  /** The one of @p names that was likely meant by @p wanted; empty: none. */
  std::string nearest_name(const std::string &wanted,
                           const std::vector<std::string> &names);

  /** At most six of @p names that may have been meant by @p wanted: those that
      have all of its words, then the nearest ones. */
  std::vector<std::string> near_names(const std::string &wanted,
                                      const std::vector<std::string> &names);

  /** known_names() for a message that @p wanted is none of @p items; ". The
     nearest one is 'b'" follows if that was likely meant. */
  template <typename Items, typename NameOf>
  std::string known_names_like(const std::string &wanted, const Items &items,
                               const NameOf &name_of)
  {
    std::vector<std::string> names;
    for (const auto &item : items)
      names.push_back(std::invoke(name_of, item));
    const std::string nearest = nearest_name(wanted, names);
    return known_names(names)
           + (nearest.empty() ? "" : ". The nearest one is '" + nearest + "'");
  }
  template <typename Names>
  std::string known_names_like(const std::string &wanted, const Names &names)
  {
    return known_names_like(wanted, names,
                            [](const std::string &name) { return name; });
  }
} // namespace quoin

#endif
