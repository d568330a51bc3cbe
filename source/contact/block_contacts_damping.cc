// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Dashpots of the contact operator.

#include <quoin/contact/block_contacts.h>

#include <algorithm>

#include "contact_points.h"
#include "dashpot_tractions.h"

namespace quoin
{
  bool BlockContacts::has_dashpots() const
  {
    return dashpots.knows_blocks()
           && std::any_of(dampings.begin(), dampings.end(),
                          [](const JointDamping &damping)
                          { return damping.acts(); });
  }

  void BlockContacts::bind_dashpots(const ContactState &contacts)
  {
    std::vector<PairDashpots::Item> items;
    for (const ContactPair &pair : contacts.pairs)
    {
      const ContactEdge &a = edges[pair.lower], &b = edges[pair.upper];
      items.push_back({ { { a.block, b.block } }, { { a.group, b.group } } });
    }
    dashpots.bind(items);
  }

  void BlockContacts::note_dashpot(const unsigned int i, const unsigned int k,
                                   const Geometry &g,
                                   const std::array<double, 2> &gap,
                                   const std::array<double, 2> &stiffness)
  {
    dashpots.add_springs(i, pair_share[i], g.area[k] * stiffness[0],
                         g.area[k] * stiffness[1]);
    dashpot_points.push_back({ i, k, g, gap, stiffness });
  }

  void BlockContacts::add_dashpot_forces(const ContactState &contacts)
  {
    dashpots.sum_over_ranks();
    for (const DashpotPoint &at : dashpot_points)
    {
      const ContactPair &pair     = contacts.pairs[at.pair];
      const JointDamping &damping = dampings[pair.set];
      const double area           = at.geometry.area[at.k];
      if (!damping.acts() || area == 0.)
        continue;
      const Edge &a        = local_edges[pair_edges[at.pair][0]];
      const Edge &b        = local_edges[pair_edges[at.pair][1]];
      const double lower   = at.geometry.lower[at.k];
      const double upper   = at.geometry.upper[at.k];
      const double *normal = at.geometry.normal[at.k];
      double v[2];
      relative_velocity(a, b, lower, upper, v);
      const std::array<double, 2> rate
          = { { v[0] * normal[0] + v[1] * normal[1],
                v[0] * normal[1] - v[1] * normal[0] } };
      const auto times = dashpots.times(at.pair, damping, at.stiffness);
      std::array<double, 2> traction{};
      with_law(pair.set,
               [&](const auto &law)
               {
                 traction = dashpot_tractions(
                     law, read_point(law, pair.points[at.k]), at.gap, rate,
                     times);
               });
      const double sigma = area * traction[0], tau = area * traction[1];
      const double f[2] = { sigma * normal[0] + tau * normal[1],
                            sigma * normal[1] - tau * normal[0] };
      spread(a, b, lower, upper, f, compact_viscous.data());
    }
  }
} // namespace quoin
