// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/dashpot_bounds.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
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

  void MatchedJoints::add_damping_bound(const std::vector<double> &masses,
                                        const double impedance,
                                        DampingBound &bound) const
  {
    add_dashpots(*node_map, thickness, sets_on_blocks(*this, *node_map),
                 all_laws, dampings, masses, impedance, bound);
  }

} // namespace quoin
