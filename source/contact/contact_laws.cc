// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/contact/contact_laws.h>
#include <quoin/joint_elements/dashpot_bounds.h>

#include <algorithm>

#include "contact_points.h"

namespace quoin
{
  namespace
  {
    /** No set says how two materials touch. */
    constexpr unsigned int no_set = -1;

    /** The set that new contacts between two of @p materials follow: entry
        i n + j of a square table is an index into @p sets, or no_set. */
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
      std::vector<unsigned int> result(n * n, no_set);
      unsigned int of_all = no_set;
      for (unsigned int s = 0; s < sets.size(); ++s)
      {
        const JointSetParameters &set = sets[s];
        const auto twice
            = [&](const unsigned int first, const std::string &what)
        {
          throw InputError("section 'Joints/" + set.name
                           + "': new contacts between " + what
                           + " follow the set '" + sets[first].name
                           + "' already. Name them once.");
        };
        if (set.all_new_contacts)
        {
          if (of_all != no_set)
            twice(of_all, "'all'");
          of_all = s;
        }
        for (const auto &[first, second] : set.new_contacts)
        {
          const unsigned int i = find(set, first), j = find(set, second);
          if (result[i * n + j] != no_set)
            twice(result[i * n + j], first + ":" + second);
          result[i * n + j] = result[j * n + i] = s;
        }
      }
      std::replace(result.begin(), result.end(), no_set, of_all);
      return result;
    }
  } // namespace

  ContactLaws::ContactLaws(const std::vector<JointSetParameters> &sets,
                           const std::vector<std::string> &materials,
                           const std::vector<unsigned int> &material_of_group)
    : n_materials(materials.size()),
      set_of_materials(sets_of_new_contacts(sets, materials))
  {
    set_properties(sets, material_of_group);
    const unsigned int n = n_materials;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        if (set_of_materials[i * n + j] == no_set)
          throw InputError(
              "section 'Joints': with 'Contact/Displacements = large' "
              "blocks of '"
              + materials[i] + "' and '" + materials[j]
              + "' may touch anew, but no set says how. Give one 'New "
                "contacts between = "
              + materials[i] + ":" + materials[j] + "' or 'all'.");
  }

  void ContactLaws::set_properties(const std::vector<JointSetParameters> &sets,
                                   const std::vector<unsigned int> &of_group)
  {
    material_of_group = of_group;
    all_laws.clear();
    all_dampings.clear();
    any_dilates = false;
    for (const JointSetParameters &set : sets)
    {
      all_laws.push_back(set.law);
      all_dampings.push_back(set.damping);
      any_dilates = any_dilates || can_dilate(set.law);
    }
  }

  double ContactLaws::release(ContactPair &pair) const
  {
    double energy = 0.;
    for (ContactPoint &point : pair.points)
    {
      with_law(pair.set, [&](const auto &law)
               { energy += point.area * released_energy(law, point); });
      point = ContactPoint();
    }
    pair.active    = 0;
    pair.was_joint = 0;
    pair.shift     = 0.;
    return energy;
  }

  std::vector<std::uint8_t>
  ContactLaws::sets_on_blocks(const MatchedJoints &joints,
                              const NodeMap<2> &node_map) const
  {
    const MPI_Comm communicator    = node_map.communicator();
    const unsigned int n_sets      = all_laws.size();
    const unsigned int n           = n_materials;
    std::vector<std::uint8_t> acts = quoin::sets_on_blocks(joints, node_map);
    const auto material            = [&](const unsigned int cell)
    { return material_of_group[node_map.cells().group[cell]]; };
    std::vector<std::uint8_t> is_there(n, 0);
    for (unsigned int c = 0; c < node_map.cells().size(); ++c)
      is_there[material(c)] = 1;
    MPI_Allreduce(MPI_IN_PLACE, is_there.data(), n, MPI_UINT8_T, MPI_MAX,
                  communicator);
    for (unsigned int c = 0; c < node_map.cells().size(); ++c)
      for (unsigned int m = 0; m < n; ++m)
        if (is_there[m])
          acts[node_map.blocks().block_of_cell(c) * n_sets
               + set_of_materials[material(c) * n + m]]
              = 1;
    MPI_Allreduce(MPI_IN_PLACE, acts.data(), acts.size(), MPI_UINT8_T, MPI_MAX,
                  communicator);
    return acts;
  }

} // namespace quoin
