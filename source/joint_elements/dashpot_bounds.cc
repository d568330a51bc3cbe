// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/dashpot_bounds.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  template <int dim>
  void add_dashpots(const NodeMap<dim> &nodes, const NodeAreas &area,
                    const std::vector<JointLaw> &laws,
                    const std::vector<JointDamping> &dampings,
                    const std::vector<double> &masses, const double impedance,
                    DampingBound &bound)
  {
    const unsigned int n_sets = laws.size();
    for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
    {
      const unsigned int b = nodes.block_of_node(i);
      double dashpot       = 0.;
      for (unsigned int s = 0; s < n_sets; ++s)
      {
        const auto [kn, ks] = stiffness_bound(laws[s]);
        const double root   = std::max(dampings[s].normal * std::sqrt(kn),
                                       dampings[s].shear * std::sqrt(ks));
        dashpot             = std::max(
                        dashpot,
                        2. * root * std::sqrt(masses[b * n_sets + s] * area[i][0]));
      }
      // As a spring, between two nodes it counts twice at each.
      bound.dashpot[i] += 2. * std::min(dashpot, impedance * area[i][0]);
    }
    for (unsigned int b = 0; b < bound.share.size(); ++b)
    {
      double share = 0.;
      for (unsigned int s = 0; s < n_sets; ++s)
        if (masses[b * n_sets + s] > 0.)
          share = std::max({ share, dampings[s].normal, dampings[s].shear });
      bound.share[b] += share;
    }
  }

  template void add_dashpots(const NodeMap<2> &, const NodeAreas &,
                             const std::vector<JointLaw> &,
                             const std::vector<JointDamping> &,
                             const std::vector<double> &, double,
                             DampingBound &);
  template void add_dashpots(const NodeMap<3> &, const NodeAreas &,
                             const std::vector<JointLaw> &,
                             const std::vector<JointDamping> &,
                             const std::vector<double> &, double,
                             DampingBound &);
} // namespace quoin
