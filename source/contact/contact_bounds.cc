// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What contacts that may come up and the dashpots of joints and contacts mean
// for the stable time step.

#include <quoin/contact/block_contacts.h>
#include <quoin/joint_elements/matched_joints.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Calls @p use (nodes, half of the area [m^2]) for the edges of own blocks
        on their boundaries. */
    template <typename Use>
    void for_each_boundary_edge(const NodeMap<2> &nodes,
                                const Thickness &thickness, const Use &use)
    {
      const auto take =
          [&](const std::array<unsigned int, 2> &edge, const unsigned int group)
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

    /** Adds the dashpots of the sets that act on each block, @p acts, to
        @p bound; see ForceOperator::add_damping_bound(). */
    void add_dashpots(const NodeMap<2> &nodes, const Thickness &thickness,
                      const std::vector<std::uint8_t> &acts,
                      const std::vector<JointLaw> &laws,
                      const std::vector<JointDamping> &dampings,
                      const std::vector<double> &masses, const double impedance,
                      DampingBound &bound)
    {
      std::vector<dealii::Tensor<1, 1>> area(nodes.n_local(),
                                             dealii::Tensor<1, 1>({ 0. }));
      for_each_boundary_edge(
          nodes, thickness,
          [&](const std::array<unsigned int, 2> &edge, const double tributary)
          {
            for (const unsigned int node : edge)
              area[node][0] += tributary;
          });
      nodes.exchange().add_to_owners(area.data());
      const unsigned int n_sets = laws.size();
      for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
      {
        const unsigned int b = nodes.block_of_node(i);
        double dashpot       = 0.;
        for (unsigned int s = 0; s < n_sets; ++s)
          if (acts[b * n_sets + s])
          {
            const auto [kn, ks] = stiffness_bound(laws[s]);
            const double root   = std::max(dampings[s].normal * std::sqrt(kn),
                                           dampings[s].shear * std::sqrt(ks));
            dashpot             = std::max(dashpot,
                                           2. * root * std::sqrt(masses[b] * area[i][0]));
          }
        // As a spring, between two nodes it counts twice at each.
        bound.dashpot[i] += 2. * std::min(dashpot, impedance * area[i][0]);
      }
      for (unsigned int b = 0; b < bound.share.size(); ++b)
      {
        double share = 0.;
        for (unsigned int s = 0; s < n_sets; ++s)
          if (acts[b * n_sets + s])
            share = std::max({ share, dampings[s].normal, dampings[s].shear });
        bound.share[b] += share;
      }
    }
  } // namespace

  std::vector<std::uint8_t> sets_on_blocks(const MatchedJoints &joints,
                                           const NodeMap<2> &nodes)
  {
    const unsigned int n_sets = joints.laws().size();
    std::vector<std::uint8_t> acts(nodes.table().n_blocks() * n_sets, 0);
    for (const JointSegment &segment : joints.segments())
      for (const unsigned int b : nodes.faces().joints[segment.face].blocks)
        acts[b * n_sets + segment.set] = 1;
    MPI_Allreduce(MPI_IN_PLACE, acts.data(), acts.size(), MPI_UINT8_T, MPI_MAX,
                  nodes.communicator());
    return acts;
  }

  std::vector<std::uint8_t> BlockContacts::sets_on_blocks() const
  {
    const MPI_Comm communicator    = node_map.communicator();
    const unsigned int n_sets      = laws.size();
    const unsigned int n           = materials.size();
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

  void BlockContacts::add_stiffness_bound(
      const State<2> &, const NodeRatio &,
      std::vector<NodeStiffness<2>> &stiffness) const
  {
    // A spring k between nodes a and b has no more energy than 2 k at each.
    const auto acts           = sets_on_blocks();
    const unsigned int n_sets = laws.size();
    std::vector<double> stiffest(node_map.table().n_blocks(), 0.);
    for (unsigned int b = 0; b < stiffest.size(); ++b)
      for (unsigned int s = 0; s < n_sets; ++s)
        if (acts[b * n_sets + s])
          for (const double largest : stiffness_bound(laws[s]))
            stiffest[b] = std::max(stiffest[b], largest);
    for_each_boundary_edge(
        node_map, thickness,
        [&](const std::array<unsigned int, 2> &edge, const double tributary)
        {
          for (const unsigned int node : edge)
            for (unsigned int c = 0; c < 2; ++c)
              stiffness[node][c]
                  += 2. * stiffest[node_map.block_of_node(node)] * tributary;
        });
  }

  void MatchedJoints::add_damping_bound(const std::vector<double> &masses,
                                        const double impedance,
                                        DampingBound &bound) const
  {
    add_dashpots(*node_map, thickness, sets_on_blocks(*this, *node_map),
                 all_laws, dampings, masses, impedance, bound);
  }

  void BlockContacts::add_damping_bound(const std::vector<double> &masses,
                                        const double impedance,
                                        DampingBound &bound) const
  {
    add_dashpots(node_map, thickness, sets_on_blocks(), laws, dampings, masses,
                 impedance, bound);
  }
} // namespace quoin
