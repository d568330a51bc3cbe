// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Dashpots of the contact operator.

#include <algorithm>

#include "contact_pairs.h"
#include "contact_points.h"
#include <quoin/joint_elements/dashpot_tractions.h>

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

  void BlockContacts::note_dashpot(const DashpotPoint &point)
  {
    dashpots.add_springs(point.pair, pair_weights[point.pair].share,
                         point.area * point.stiffness[0],
                         point.area * point.stiffness[1]);
    dashpot_points.push_back(point);
  }

  void BlockContacts::add_dashpot_forces(const ContactState &contacts)
  {
    dashpots.sum_over_ranks();
    for (const DashpotPoint &at : dashpot_points)
    {
      const ContactPair &pair     = contacts.pairs[at.pair];
      const JointDamping &damping = dampings[pair.set];
      if (!damping.acts() || at.area == 0.)
        continue;
      const auto &[a, b]   = pair_edges[at.pair];
      const auto &[nx, ny] = at.normal;
      double v[2];
      relative_velocity<1>(&a, &b, at.lower, at.upper, v);
      const std::array<double, 2> rate
          = { { v[0] * nx + v[1] * ny, v[0] * ny - v[1] * nx } };
      const auto times = dashpots.times(at.pair, damping, at.stiffness);
      std::array<double, 2> traction{};
      with_law(pair.set,
               [&](const auto &law)
               {
                 traction = dashpot_tractions(
                     law, read_point(law, pair.points[at.k]), at.gap, rate,
                     times);
               });
      const double sigma = at.area * traction[0], tau = at.area * traction[1];
      const double f[2] = { sigma * nx + tau * ny, sigma * ny - tau * nx };
      EdgeLanes<1> edge_a, edge_b;
      load_edges(&a, edge_a);
      load_edges(&b, edge_b);
      TractionLanes<1> forces;
      PairFunctions<1>::spread(at.lower, at.upper, f, forces);
      add_to_ends(PairFunctions<1>::end_forces(edge_a, edge_b, forces), &a, &b,
                  1, compact_viscous.data());
    }
  }
} // namespace quoin
