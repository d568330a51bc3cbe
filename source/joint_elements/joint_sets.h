// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_joint_sets_h
#define quoin_source_joint_elements_joint_sets_h

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/mesh/kind_text.h>
#include <quoin/mesh/node_map.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <string>
#include <vector>

// The set of each joint face, in two and three dimensions.

namespace quoin
{
  constexpr unsigned int no_joint_set = -1;

  /** The joint set of each name of joint faces, curves or surfaces. */
  template <int dim>
  std::vector<unsigned int>
  sets_of_names(const std::vector<std::string> &names,
                const std::vector<JointSetParameters> &sets)
  {
    std::vector<unsigned int> set_of_name(names.size(), no_joint_set);
    for (unsigned int s = 0; s < sets.size(); ++s)
      for (const std::string &curve : sets[s].curves)
      {
        const std::string name = curve == "unnamed" ? "" : curve;
        const auto found       = std::find(names.begin(), names.end(), name);
        if (found == names.end())
          throw InputError(
              "section 'Joints/" + sets[s].name + "': the mesh has no "
              + boundary_kind<dim> + " '" + curve + "'. It has: "
              + known_names_like(curve, names) + ". Correct 'Curves'.");
        unsigned int &set = set_of_name[found - names.begin()];
        if (set != no_joint_set)
          throw InputError("section 'Joints/" + sets[s].name
                           + "': " + (dim == 2 ? "curve" : "surface") + " '"
                           + curve + "' belongs to the set '" + sets[set].name
                           + "' already. Name it once.");
        set = s;
      }
    return set_of_name;
  }

  /** Throws an InputError if a joint face has no set; @p number: the first of
      this rank. Collective. */
  template <int dim>
  void refuse_without_set(const NodeMap<dim> &nodes, const unsigned int number)
  {
    const unsigned int first
        = dealii::Utilities::MPI::min(number, nodes.communicator());
    if (first == nodes.faces().n_global_joints)
      return;
    // Both ranks of a face know the same of it.
    std::vector<unsigned int> known(3, 0);
    for (const JointNodes<dim> &face : nodes.faces().joints)
      if (face.number == first)
        known = { face.name, face.groups[0], face.groups[1] };
    dealii::Utilities::MPI::max(known, nodes.communicator(), known);
    const auto &groups     = nodes.table().group_names;
    const std::string kind = dim == 2 ? "curve" : "surface";
    const std::string name = "'" + nodes.table().face_names[known[0]] + "'";
    throw InputError((known[0] == 0 ? "a joint on no named " + kind
                                    : "the joint on " + kind + " " + name)
                     + " between groups '" + groups[known[1]] + "' and '"
                     + groups[known[2]] + "' belongs to no joint set. Add "
                     + (known[0] == 0 ? "'unnamed'" : name)
                     + " to the 'Curves' of a set in section 'Joints'.");
  }
} // namespace quoin

#endif
