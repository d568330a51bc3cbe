// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// The contact operator: how pairs begin and end, and what is asked of them.
// What happens in every step is in block_contacts_lanes.cc, what happens
// between searches in block_contacts_search.cc.

#include <algorithm>
#include <cmath>

#include "contact_pairs.h"
#include "contact_points.h"

namespace quoin
{
  namespace
  {
    /** Share of the shorter edge by which edges may overlap that meet without
        having been seen apart. */
    constexpr double first_overlap = 1e-3;

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

  bool BlockContacts::geometry(const ContactPair &pair, const unsigned int i,
                               Geometry &result) const
  {
    const auto &[ea, eb] = pair_edges[i];
    EdgeLanes<1> a, b;
    load_edges(&ea, a);
    load_edges(&eb, b);
    return find_geometry<1>(one_lane(pair), &ea, a, &eb, b, result);
  }

  double BlockContacts::shift_left(const ContactPair &pair,
                                   const unsigned int i,
                                   const Geometry &g) const
  {
    EdgeLanes<1> a, b;
    load_edges(&pair_edges[i][0], a);
    load_edges(&pair_edges[i][1], b);
    return PairFunctions<1>::shift_left(one_lane(pair), a, b, g.tangent);
  }

  double BlockContacts::slip(const ContactPoint &point, const unsigned int i,
                             const double (&normal)[2]) const
  {
    EdgeLanes<1> a, b;
    load_edges(&pair_edges[i][0], a);
    load_edges(&pair_edges[i][1], b);
    return PairFunctions<1>::slip(anchor_of(point), a, b, normal);
  }

  void BlockContacts::gather_velocities(const dealii::Tensor<1, 2> *velocity)
  {
    reach->update_ghosts(velocity, ghost_velocity.data());
    dealii::Tensor<1, 2> *to = compact_velocity.data();
    for (const unsigned int i : compact_own)
      *to++ = velocity[i];
    std::copy(ghost_velocity.begin(), ghost_velocity.end(), to);
  }

  void BlockContacts::scatter(AlignedArray<dealii::Tensor<1, 2>> &from,
                              dealii::Tensor<1, 2> *to) const
  {
    for (unsigned int j = 0; j < compact_own.size(); ++j)
      for (unsigned int d = 0; d < 2; ++d)
        to[compact_own[j]][d] += from[j][d];
    std::fill(from.begin(), from.end(), dealii::Tensor<1, 2>());
  }

  double BlockContacts::release(ContactPair &pair) const
  {
    double energy = 0.;
    for (ContactPoint &point : pair.points)
    {
      with_law(pair.set, [&](const auto &law)
               { energy += point.area * released_energy(law, point); });
      point = ContactPoint();
    }
    pair.active    = 0;
    pair.was_joint = 0;
    pair.shift     = 0.;
    return energy;
  }

  bool BlockContacts::begin_contact(ContactState &contacts,
                                    const unsigned int i, const Geometry &g)
  {
    ContactPair &pair    = contacts.pairs[i];
    const double opening = std::min(g.opening[0], g.opening[1]);
    unsigned int set     = pair.set;
    ContactPoint inherited;
    double deepest     = 0.;
    const bool is_heir = find_parent(contacts, i, set, inherited, deepest);
    if (opening >= inherited.plastic_opening
        || opening <= std::min(0., inherited.plastic_opening)
                          - pair_weights[i].depth)
      return false;
    // Edges that overlap from behind, as those of thin wedges which lie on
    // each other, were never apart, and their vertices lie outside.
    const unsigned int deeper = g.opening[0] <= g.opening[1] ? 0 : 1;
    if (!pair.was_open
        && opening < deepest
                         - first_overlap
                               * std::min(local_edges[pair_edges[i][0]].length,
                                          local_edges[pair_edges[i][1]].length)
        && !vertex_is_inside(i, g, deeper))
      return false;

    if (!is_heir)
      with_law(set, [&](const auto &law) { begin_point(law, inherited); });
    pair.set         = set;
    pair.shift_start = inherited.slip_offset;
    for (unsigned int k = 0; k < 2; ++k)
    {
      ContactPoint &point = pair.points[k];
      inherited.opening
          = std::isfinite(point.opening) ? point.opening : g.opening[k];
      point              = inherited;
      point.lean         = g.lean[k];
      point.sideways     = 0.;
      point.anchor_lower = g.lower[k];
      point.anchor_upper = g.upper[k];
      // Whoever is heir to a history comes with no area, others as they are.
      point.area = is_heir ? 0. : g.area[k];
      // Such that the slip now is that of the other pair.
      point.slip_offset = 0.;
      point.slip_offset = inherited.slip_offset - slip(point, i, g.normal[k]);
    }
    return true;
  }

  bool BlockContacts::vertex_is_inside(const unsigned int i, const Geometry &g,
                                       const unsigned int k) const
  {
    const auto &[a, b]     = pair_edges[i];
    const bool is_of_a     = g.share[k] < 0.5;
    const Edge &touched    = local_edges[is_of_a ? b : a];
    const EdgeLinks &links = edge_links[is_of_a ? b : a];
    const dealii::Tensor<1, 2> &vertex
        = position[is_of_a ? edge_links[a].nodes[k]
                           : edge_links[b].nodes[1 - k]];
    for (const unsigned int e : links.neighbours)
    {
      const Edge &next     = local_edges[e];
      const bool is_before = e == links.neighbours[0];
      const double turn    = next.tangent[0] * touched.tangent[1]
                          - next.tangent[1] * touched.tangent[0];
      // Beyond an inward corner the block goes on.
      if ((is_before ? turn : -turn) <= 0.)
        continue;
      const double side = next.tangent[0] * (vertex[1] - next.y)
                          - next.tangent[1] * (vertex[0] - next.x);
      if (side < 0.)
        return false;
    }
    return true;
  }

  bool BlockContacts::find_parent(const ContactState &contacts,
                                  const unsigned int i, unsigned int &set,
                                  ContactPoint &inherited,
                                  double &deepest) const
  {
    // A pair between the same blocks that shares an edge with this one and a
    // vertex of the other; the first of two, whatever their ranks.
    for (unsigned int side = 0; side < 2; ++side)
    {
      const unsigned int shared = pair_edges[i][side];
      const auto &beside = edge_links[pair_edges[i][1 - side]].neighbours;
      for (unsigned int j = edge_pairs_begin[shared];
           j < edge_pairs_begin[shared + 1]; ++j)
      {
        const unsigned int q      = edge_pairs[j];
        const ContactPair &parent = pair_or_copy(contacts, q);
        if (q == i || !parent.active)
          continue;
        const unsigned int at    = pair_edges[q][0] == shared ? 1 : 0;
        const unsigned int other = pair_edges[q][at];
        if (other != beside[0] && other != beside[1])
          continue;
        Geometry g;
        if (!geometry(parent, q, g))
          continue;
        const double vertex = other == beside[1] ? 0. : 1.;
        const double *place = at == 0 ? g.lower : g.upper;
        const unsigned int k
            = std::abs(place[0] - vertex) <= std::abs(place[1] - vertex) ? 0
                                                                         : 1;
        deepest               = std::min(g.opening[0], g.opening[1]);
        set                   = parent.set;
        inherited             = parent.points[k];
        inherited.slip_offset = slip(inherited, q, g.normal[k]);
        return true;
      }
    }
    return false;
  }

  double BlockContacts::stored_energy(const State<2> &state) const
  {
    const ContactState &contacts = state.get<ContactState>();
    double energy                = 0.;
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
    {
      const ContactPair &pair = contacts.pairs[i];
      if (!pair.active)
        continue;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const ContactPoint &point = pair.points[k];
        with_law(pair.set,
                 [&](const auto &law)
                 {
                   energy += pair_weights[i].share * point.area
                             * law.stored_energy(read_point(law, point),
                                                 point.opening);
                 });
      }
    }
    return energy;
  }

  double BlockContacts::n_touching(const ContactState &contacts) const
  {
    double n = 0.;
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
      for (const ContactPoint &point : contacts.pairs[i].points)
        if (contacts.pairs[i].active && point.normal_traction < 0.)
          n += pair_weights[i].share;
    return n;
  }

  bool BlockContacts::contact(const ContactState &contacts,
                              const unsigned int i, Contact &result) const
  {
    const ContactPair &pair = contacts.pairs[i];
    const Edge &a           = local_edges[pair_edges[i][0]];
    const Edge &b           = local_edges[pair_edges[i][1]];
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

  bool BlockContacts::end_forces(const ContactState &contacts,
                                 const unsigned int i, EndForces &result) const
  {
    const ContactPair &pair = contacts.pairs[i];
    Geometry g;
    if (!pair.active || !geometry(pair, i, g))
      return false;
    EdgeLanes<1> a, b;
    load_edges(&pair_edges[i][0], a);
    load_edges(&pair_edges[i][1], b);
    TractionLanes<1> sum;
    for (unsigned int k = 0; k < 2; ++k)
    {
      const ContactPoint &point = pair.points[k];
      PairFunctions<1>::add_tractions(a, b, g, k, anchor_of(point),
                                      point.area * point.normal_traction,
                                      point.area * point.shear_traction, sum);
    }
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
    result.share = pair_weights[i].share;
    return true;
  }

  bool BlockContacts::is_own(const ContactState &contacts,
                             const unsigned int pair) const
  {
    return edges.is_own(contacts.pairs[pair].lower);
  }
} // namespace quoin
