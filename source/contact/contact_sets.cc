// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/contact/contact_sets.h>

#include <algorithm>

namespace quoin
{
  std::vector<unsigned int>
  sets_of_new_contacts(const std::vector<JointSetParameters> &sets,
                       const std::vector<std::string> &materials)
  {
    const unsigned int n = materials.size();
    const auto find      = [&](const JointSetParameters &set,
                          const std::string &name) -> unsigned int
    {
      const auto found = std::find(materials.begin(), materials.end(), name);
      if (found != materials.end())
        return found - materials.begin();
      throw InputError("section 'Joints/" + set.name
                       + "': 'New contacts between' names '" + name
                       + "', which is no material. Materials are: "
                       + known_names_like(name, materials) + ".");
    };
    std::vector<unsigned int> result(n * n, no_contact_set);
    unsigned int of_all = no_contact_set;
    for (unsigned int s = 0; s < sets.size(); ++s)
    {
      const JointSetParameters &set = sets[s];
      const auto twice = [&](const unsigned int first, const std::string &what)
      {
        throw InputError("section 'Joints/" + set.name
                         + "': new contacts between " + what
                         + " follow the set '" + sets[first].name
                         + "' already. Name them once.");
      };
      if (set.all_new_contacts)
      {
        if (of_all != no_contact_set)
          twice(of_all, "'all'");
        of_all = s;
      }
      for (const auto &[first, second] : set.new_contacts)
      {
        const unsigned int i = find(set, first), j = find(set, second);
        if (result[i * n + j] != no_contact_set)
          twice(result[i * n + j], first + ":" + second);
        result[i * n + j] = result[j * n + i] = s;
      }
    }
    std::replace(result.begin(), result.end(), no_contact_set, of_all);
    return result;
  }
} // namespace quoin
