// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact_geometry/edge_lanes.h>
#include <quoin/contact_geometry/near_pairs.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    AnchorLanes<1> anchor_of(const ContactPoint &point)
    {
      return { point.slip_offset, point.anchor_lower, point.anchor_upper };
    }

    PairLanes<1> one_lane(const ContactPair &pair)
    {
      return { pair.was_joint != 0, pair.shift, pair.shift_start,
               anchor_of(pair.points[0]), pair.active != 0 };
    }
  } // namespace

  NearPairs::NearPairs(const NodeMap<2> &nodes, ContactEdges &edges,
                       const ContactParameters &parameters,
                       const Thickness &thickness)
    : edges(edges), deepest(parameters.deepest),
      moving(nodes, edges, parameters, thickness),
      copies(edges, nodes.communicator())
  {
  }

  void NearPairs::bind(const ContactState &contacts)
  {
    moving.bind(contacts.pairs);
    copies.bind(contacts.pairs);
    const unsigned int n_pairs = contacts.pairs.size();
    pair_edges.clear();
    pair_weights.clear();
    edge_pairs_begin.assign(moving.n_edges() + 1, 0);
    const auto add_edges = [this](const ContactPair &pair)
    {
      pair_edges.push_back(
          { { moving.local_edge(pair.lower), moving.local_edge(pair.upper) } });
      for (const unsigned int e : pair_edges.back())
        ++edge_pairs_begin[e + 1];
    };
    for (const ContactPair &pair : contacts.pairs)
    {
      add_edges(pair);
      pair_weights.push_back(
          { share(pair), deepest
                             * std::min(edges[pair.lower].height,
                                        edges[pair.upper].height) });
    }
    for (const ContactPair &pair : copies.pairs())
      add_edges(pair);
    for (unsigned int e = 0; e < moving.n_edges(); ++e)
      edge_pairs_begin[e + 1] += edge_pairs_begin[e];
    edge_pairs.resize(2 * pair_edges.size());
    std::vector<unsigned int> place(edge_pairs_begin.begin(),
                                    edge_pairs_begin.end() - 1);
    for (unsigned int i = 0; i < pair_edges.size(); ++i)
      for (const unsigned int e : pair_edges[i])
        edge_pairs[place[e]++] = i;
    // Copies came last.
    for (unsigned int i = n_pairs; i < pair_edges.size(); ++i)
      for (const unsigned int e : pair_edges[i])
        std::sort(edge_pairs.begin() + edge_pairs_begin[e],
                  edge_pairs.begin() + edge_pairs_begin[e + 1],
                  [&](const unsigned int p, const unsigned int q)
                  {
                    return pair_or_copy(contacts, p).edges()
                           < pair_or_copy(contacts, q).edges();
                  });
    pair_edges.resize(pair_edges.size() + MovingEdges::most_lanes,
                      { { 0, 0 } });
  }

  float NearPairs::share(const ContactPair &pair) const
  {
    return 0.5f * (edges.is_own(pair.lower) + edges.is_own(pair.upper));
  }

  bool NearPairs::geometry(const ContactPair &pair, const unsigned int i,
                           Geometry &result) const
  {
    const auto &[ea, eb] = pair_edges[i];
    EdgeLanes<1> a, b;
    moving.load(&ea, a);
    moving.load(&eb, b);
    return moving.find_geometry<1>(one_lane(pair), &ea, a, &eb, b, result);
  }

  double NearPairs::shift_left(const ContactPair &pair, const unsigned int i,
                               const Geometry &g) const
  {
    EdgeLanes<1> a, b;
    moving.load(&pair_edges[i][0], a);
    moving.load(&pair_edges[i][1], b);
    return PairFunctions<1>::shift_left(one_lane(pair), a, b, g.tangent);
  }

  double NearPairs::slip(const ContactPoint &point, const unsigned int i,
                         const double (&normal)[2]) const
  {
    EdgeLanes<1> a, b;
    moving.load(&pair_edges[i][0], a);
    moving.load(&pair_edges[i][1], b);
    return PairFunctions<1>::slip(anchor_of(point), a, b, normal);
  }

  bool NearPairs::contact(const ContactState &contacts, const unsigned int i,
                          Contact &result) const
  {
    const ContactPair &pair    = contacts.pairs[i];
    const MovingEdges::Edge &a = moving[pair_edges[i][0]];
    const MovingEdges::Edge &b = moving[pair_edges[i][1]];
    Geometry g;
    if (!pair.active || !geometry(pair, i, g))
      return false;
    result.set   = pair.set;
    result.share = pair_weights[i].share;
    for (unsigned int k = 0; k < 2; ++k)
    {
      const double la = g.lower[k] * a.length, lb = g.upper[k] * b.length;
      result.lower[k]
          = dealii::Point<2>(a.x + la * a.tangent[0], a.y + la * a.tangent[1]);
      result.upper[k]
          = dealii::Point<2>(b.x + lb * b.tangent[0], b.y + lb * b.tangent[1]);
      const ContactPoint &point = pair.points[k];
      const double sigma        = point.area * point.normal_traction;
      const double tau          = point.area * point.shear_traction;
      const auto &[nx, ny]      = g.normal[k];
      result.force[k]
          = dealii::Point<2>(sigma * nx + tau * ny, sigma * ny - tau * nx);
      const auto &[p, q]  = edges[pair.lower].points;
      result.reference[k] = dealii::Point<2>(p[0] + g.lower[k] * (q[0] - p[0]),
                                             p[1] + g.lower[k] * (q[1] - p[1]));
      result.opening[k]   = g.opening[k];
      result.slip[k]      = slip(pair.points[k], i, g.normal[k]);
    }
    return true;
  }

  namespace
  {
    ContactEndForces forces_at_ends(const EdgeLanes<1> &a,
                                    const EdgeLanes<1> &b,
                                    const TractionLanes<1> &sum,
                                    const double share)
    {
      ContactEndForces result;
      result.share                 = share;
      const EndForceLanes<1> force = PairFunctions<1>::end_forces(a, b, sum);
      for (unsigned int n = 0; n < 4; ++n)
      {
        const EdgeLanes<1> &edge = n < 2 ? a : b;
        const auto &f            = n < 2 ? force.a[n] : force.b[n - 2];
        const double distance    = n % 2 == 0 ? 0. : edge.length;
        result.place[n] = dealii::Point<2>(edge.x + distance * edge.tangent[0],
                                           edge.y + distance * edge.tangent[1]);
        result.force[n] = dealii::Point<2>(f[0], f[1]);
      }
      return result;
    }
  } // namespace

  ContactEndForces NearPairs::spread(const unsigned int i, const double lower,
                                     const double upper,
                                     const double (&force)[2]) const
  {
    EdgeLanes<1> a, b;
    moving.load(&pair_edges[i][0], a);
    moving.load(&pair_edges[i][1], b);
    TractionLanes<1> sum;
    PairFunctions<1>::spread(lower, upper, force, sum);
    return forces_at_ends(a, b, sum, pair_weights[i].share);
  }

  bool NearPairs::end_forces(const ContactState &contacts, const unsigned int i,
                             ContactEndForces &result) const
  {
    const ContactPair &pair = contacts.pairs[i];
    Geometry g;
    if (!pair.active || !geometry(pair, i, g))
      return false;
    EdgeLanes<1> a, b;
    moving.load(&pair_edges[i][0], a);
    moving.load(&pair_edges[i][1], b);
    TractionLanes<1> sum;
    for (unsigned int k = 0; k < 2; ++k)
    {
      const ContactPoint &point = pair.points[k];
      PairFunctions<1>::add_tractions(a, b, g, k, anchor_of(point),
                                      point.area * point.normal_traction,
                                      point.area * point.shear_traction, sum);
    }
    result = forces_at_ends(a, b, sum, pair_weights[i].share);
    return true;
  }

  double n_touching(const NearPairs &near, const ContactState &contacts)
  {
    double n = 0.;
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
      for (const ContactPoint &point : contacts.pairs[i].points)
        if (contacts.pairs[i].active && point.normal_traction < 0.)
          n += near.weights()[i].share;
    return n;
  }
} // namespace quoin
