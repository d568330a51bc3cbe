// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_dashpot_bounds_h
#define quoin_joint_elements_dashpot_bounds_h

#include <quoin/joint_elements/joint_changes.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Calls @p use (nodes, area of each [m^2]) for the faces of own blocks on
      their boundaries. */
  template <int dim, typename Use>
  void for_each_boundary_face(const NodeMap<dim> &nodes,
                              const Thickness &thickness, const Use &use)
  {
    const auto take =
        [&](const std::array<unsigned int, dim> &face, const unsigned int group)
    {
      const auto edge = [&](const unsigned int k)
      { return nodes.point(face[k]) - nodes.point(face[0]); };
      if constexpr (dim == 2)
        use(face, 0.5 * edge(1).norm() * thickness[group]);
      else
        use(face, cross_product_3d(edge(1), edge(2)).norm() / 6.);
    };
    for (const OuterFace<dim> &face : nodes.faces().outer)
      take(face.nodes, nodes.cells().group[face.cell]);
    for (const JointNodes<dim> &face : nodes.faces().joints)
    {
      if (face.is_own[0])
        take(face.lower, face.groups[0]);
      if (face.is_own[1])
        take(face.upper, face.groups[1]);
    }
  }

  /** Which sets have joints at each block of the mesh: entry b n + s is 1 if
     set s of n has. Collective. */
  template <int dim>
  std::vector<std::uint8_t> sets_on_blocks(const JointsOf<dim> &joints,
                                           const NodeMap<dim> &nodes)
  {
    const unsigned int n_sets = joints.laws().size();
    std::vector<std::uint8_t> acts(nodes.table().n_blocks() * n_sets, 0);
    for (const auto &face : joint_faces(joints))
      for (const unsigned int b : nodes.faces().joints[face.face].blocks)
        acts[b * n_sets + face.set] = 1;
    MPI_Allreduce(MPI_IN_PLACE, acts.data(), acts.size(), MPI_UINT8_T, MPI_MAX,
                  nodes.communicator());
    return acts;
  }

  /**
   * Adds the dashpots of the sets that act on each block to @p bound, see
   * ForceOperator::add_damping_bound(). @p acts: see sets_on_blocks(); @p laws
   * and @p dampings of each set. Collective.
   */
  template <int dim>
  void add_dashpots(const NodeMap<dim> &nodes, const Thickness &thickness,
                    const std::vector<std::uint8_t> &acts,
                    const std::vector<JointLaw> &laws,
                    const std::vector<JointDamping> &dampings,
                    const std::vector<double> &masses, double impedance,
                    DampingBound &bound);
} // namespace quoin

#endif
