// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_named_sections_h
#define quoin_base_named_sections_h

#include <quoin/base/parameter_section.h>

#include <string>
#include <vector>

namespace quoin
{
  /** T::read() of each subsection of @p section_name that its 'Names' lists. */
  template <typename T>
  std::vector<T> read_named(const ParameterSection &top,
                            const std::string &section_name)
  {
    const ParameterSection section(top, section_name);
    std::vector<T> result;
    for (const std::string &name : section.list("Names"))
      result.push_back(T::read(ParameterSection(section, name), name));
    return result;
  }
} // namespace quoin

#endif
