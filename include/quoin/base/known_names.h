// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_known_names_h
#define quoin_base_known_names_h

#include <algorithm>
#include <functional>
#include <string>

namespace quoin
{
  /**
   * "a, b" for a message that lists known names: @p name_of, a function or a
   * pointer to a member, of each of @p items. Empty names are left out; "none"
   * if nothing is left.
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

  /** "a, b" for a message that lists @p names. */
  template <typename Names>
  std::string known_names(const Names &names)
  {
    return known_names(names, [](const std::string &name) { return name; });
  }

  /** The item of @p items whose name is @p name, or null. */
  template <typename Items>
  const typename Items::value_type *find_named(const Items &items,
                                               const std::string &name)
  {
    const auto found
        = std::find_if(items.begin(), items.end(),
                       [&](const auto &item) { return item.name == name; });
    return found == items.end() ? nullptr : &*found;
  }

  /** Whether @p name is one of @p names. */
  template <typename Names>
  bool is_among(const std::string &name, const Names &names)
  {
    return std::find(names.begin(), names.end(), name) != names.end();
  }
} // namespace quoin

#endif
