// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/mesh/block_table.h>
#include <quoin/mesh/kind_text.h>

namespace quoin
{
  template <int dim>
  std::vector<bool> find_groups(const BlockTable<dim> &table,
                                const std::vector<std::string> &names,
                                const std::string &where)
  {
    const std::vector<std::string> &known = table.group_names;
    std::vector<bool> result(known.size(), false);
    for (const std::string &name : names)
    {
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        throw InputError(where + ": the mesh has no " + group_kind<dim> + " '"
                         + name + "'. It has: " + known_names_like(name, known)
                         + ". Name one of these.");
      result[found - known.begin()] = true;
    }
    return result;
  }

  template std::vector<bool> find_groups(const BlockTable<2> &,
                                         const std::vector<std::string> &,
                                         const std::string &);
  template std::vector<bool> find_groups(const BlockTable<3> &,
                                         const std::vector<std::string> &,
                                         const std::string &);
} // namespace quoin
