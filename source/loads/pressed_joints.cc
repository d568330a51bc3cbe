// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/loads/pressed_joints.h>

#include <algorithm>

namespace quoin
{
  template <int dim>
  PressedJoints::PressedJoints(const NodeMap<dim> &node_map,
                               const std::vector<std::string> &curves,
                               const Thickness &thickness)
    : communicator(node_map.communicator())
  {
    for (const JointNodes<dim> &joint : node_map.faces().joints)
      if (is_among(node_map.table().face_names[joint.name], curves))
      {
        blocks.push_back({ node_map.block_of_node(joint.lower[0]),
                           node_map.block_of_node(joint.upper[0]) });
        if (thickness[joint.groups[0]] != thickness[joint.groups[1]])
          uneven_blocks.push_back(blocks.back());
      }
    some_exist
        = dealii::Utilities::MPI::max(unsigned(!blocks.empty()), communicator)
          > 0;
  }

  template <int dim>
  bool PressedJoints::have_bared_sides(const State<dim> &state,
                                       const bool uneven) const
  {
    if (!some_exist)
      return false;
    const auto &sides   = uneven ? uneven_blocks : blocks;
    const bool is_bared = std::any_of(
        sides.begin(), sides.end(),
        [&](const auto &pair)
        { return state.is_absent(pair[0]) != state.is_absent(pair[1]); });
    return dealii::Utilities::MPI::max(unsigned(is_bared), communicator) > 0;
  }

  template <int dim>
  void PressedJoints::refuse_bared_sides(const std::string &load,
                                         const std::string &name,
                                         const State<dim> &state) const
  {
    if (have_bared_sides(state, true))
      throw InputError("section 'Loads/" + load
                       + "': 'Pressure' acts in a joint between groups of "
                         "different 'Thickness', over the smaller one, but in "
                         "the stage '"
                       + name
                       + "' the block on one side of it is excavated or not "
                         "there yet. Give both groups the same 'Thickness', or "
                         "leave this load out of the stage.");
  }

  template PressedJoints::PressedJoints(const NodeMap<2> &,
                                        const std::vector<std::string> &,
                                        const Thickness &);
  template PressedJoints::PressedJoints(const NodeMap<3> &,
                                        const std::vector<std::string> &,
                                        const Thickness &);
  template bool PressedJoints::have_bared_sides(const State<2> &, bool) const;
  template bool PressedJoints::have_bared_sides(const State<3> &, bool) const;
  template void PressedJoints::refuse_bared_sides(const std::string &,
                                                  const std::string &,
                                                  const State<2> &) const;
  template void PressedJoints::refuse_bared_sides(const std::string &,
                                                  const std::string &,
                                                  const State<3> &) const;
} // namespace quoin
