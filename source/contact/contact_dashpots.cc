// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/contact_dashpots.h>
#include <quoin/contact_geometry/edge_lanes.h>
#include <quoin/joint_elements/dashpot_tractions.h>

#include <algorithm>

#include "contact_points.h"

namespace quoin
{
  bool ContactDashpots::act() const
  {
    return pairs.knows_blocks()
           && std::any_of(laws.dampings().begin(), laws.dampings().end(),
                          [](const JointDamping &damping)
                          { return damping.acts(); });
  }

  void ContactDashpots::bind(const ContactState &contacts,
                             const ContactEdges &edges)
  {
    std::vector<PairDashpots::Item> items;
    for (const ContactPair &pair : contacts.pairs)
    {
      const ContactEdge &a = edges[pair.lower], &b = edges[pair.upper];
      items.push_back({ { { a.block, b.block } }, { { a.group, b.group } } });
    }
    pairs.bind(items);
  }

  void ContactDashpots::clear()
  {
    pairs.clear();
    dashpots.clear();
  }

  void ContactDashpots::add_forces(const ContactState &contacts,
                                   dealii::Tensor<1, 2> *force)
  {
    const MovingEdges &moving = near.moving_edges();
    pairs.sum_over_ranks();
    for (ContactDashpot &at : dashpots)
    {
      const ContactPair &pair     = contacts.pairs[at.pair];
      const JointDamping &damping = laws.dampings()[pair.set];
      if (!damping.acts() || at.area == 0.)
        continue;
      const auto &[a, b]   = near.edges_of(at.pair);
      const auto &[nx, ny] = at.normal;
      double v[2];
      moving.relative_velocity<1>(&a, &b, at.lower, at.upper, v);
      const JointVector<2> rate
          = { v[0] * nx + v[1] * ny, v[0] * ny - v[1] * nx };
      const auto times = pairs.times(at.pair, damping, at.stiffness);
      JointVector<2> traction;
      laws.with_law(pair.set,
                    [&](const auto &law)
                    {
                      traction = dashpot_tractions<2>(
                          law, read_point(law, pair.points[at.k]),
                          { at.gap[0], at.gap[1] }, rate, times);
                    });
      const double sigma = at.area * traction.normal,
                   tau   = at.area * traction.shear;
      at.force[0]        = sigma * nx + tau * ny;
      at.force[1]        = sigma * ny - tau * nx;
      EdgeLanes<1> edge_a, edge_b;
      moving.load(&a, edge_a);
      moving.load(&b, edge_b);
      TractionLanes<1> forces;
      PairFunctions<1>::spread(at.lower, at.upper, at.force, forces);
      moving.add_to_ends(PairFunctions<1>::end_forces(edge_a, edge_b, forces),
                         &a, &b, 1, force);
    }
  }
} // namespace quoin
