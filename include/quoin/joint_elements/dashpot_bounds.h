// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_dashpot_bounds_h
#define quoin_joint_elements_dashpot_bounds_h

#include <quoin/joint_elements/joint_changes.h>

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

  /** Areas at the local nodes [m^2]. */
  using NodeAreas = std::vector<dealii::Tensor<1, 1>>;

  /** Area of the joints at each owned node. Collective. */
  template <int dim>
  NodeAreas joint_areas(const JointsOf<dim> &joints, const NodeMap<dim> &nodes)
  {
    NodeAreas area(nodes.n_local());
    for (const auto &face : joint_faces(joints))
    {
      const auto &is_own = nodes.faces().joints[face.face].is_own;
      for (unsigned int k = 0; k < dim; ++k)
      {
        area[face.lower[k]][0] += is_own[0] ? point_area(face, k) : 0.;
        area[face.upper[k]][0] += is_own[1] ? point_area(face, k) : 0.;
      }
    }
    nodes.exchange().add_to_owners(area.data());
    return area;
  }

  /**
   * Adds the dashpots of the sets that act on each block to @p bound, see
   * ForceOperator::add_damping_bound(). @p area: where they may act, of owned
   * nodes; @p laws and @p dampings of each set; @p masses: see
   * dashpot_masses().
   */
  template <int dim>
  void add_dashpots(const NodeMap<dim> &nodes, const NodeAreas &area,
                    const std::vector<JointLaw> &laws,
                    const std::vector<JointDamping> &dampings,
                    const std::vector<double> &masses, double impedance,
                    DampingBound &bound);
} // namespace quoin

#endif
