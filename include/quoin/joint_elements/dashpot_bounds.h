// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_dashpot_bounds_h
#define quoin_joint_elements_dashpot_bounds_h

#include <quoin/joint_elements/matched_joints.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Calls @p use (nodes, half of the area [m^2]) for the edges of own blocks
      on their boundaries. */
  template <typename Use>
  void for_each_boundary_edge(const NodeMap<2> &nodes,
                              const Thickness &thickness, const Use &use)
  {
    const auto take
        = [&](const std::array<unsigned int, 2> &edge, const unsigned int group)
    {
      use(edge, 0.5 * nodes.point(edge[0]).distance(nodes.point(edge[1]))
                    * thickness[group]);
    };
    for (const OuterFace<2> &face : nodes.faces().outer)
      take(face.nodes, nodes.cells().group[face.cell]);
    for (const JointNodes<2> &face : nodes.faces().joints)
    {
      if (face.is_own[0])
        take(face.lower, face.groups[0]);
      if (face.is_own[1])
        take(face.upper, face.groups[1]);
    }
  }

  /**
   * Adds the dashpots of the sets that act on each block to @p bound, see
   * ForceOperator::add_damping_bound(). @p acts: see sets_on_blocks(); @p laws
   * and @p dampings of each set. Collective.
   */
  void add_dashpots(const NodeMap<2> &nodes, const Thickness &thickness,
                    const std::vector<std::uint8_t> &acts,
                    const std::vector<JointLaw> &laws,
                    const std::vector<JointDamping> &dampings,
                    const std::vector<double> &masses, double impedance,
                    DampingBound &bound);
} // namespace quoin

#endif
