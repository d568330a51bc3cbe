// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_known_names_h
#define quoin_base_known_names_h

#include <functional>
#include <string>

namespace quoin
{
  /**
   * "a, b" for a message that says what there is: @p name_of each of @p items,
   * a function or a pointer to a member. Empty names are left out; "none" if
   * nothing is left.
   */
  template <typename Items, typename NameOf>
  std::string known_names(const Items &items, const NameOf &name_of)
  {
    std::string text;
    for (const auto &item : items)
    {
      const std::string name = std::invoke(name_of, item);
      if (!name.empty())
        text += (text.empty() ? "" : ", ") + name;
    }
    return text.empty() ? "none" : text;
  }

  /** The same of names. */
  template <typename Names>
  std::string known_names(const Names &names)
  {
    return known_names(names, [](const std::string &name) { return name; });
  }
} // namespace quoin

#endif
