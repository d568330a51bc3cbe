// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// The contact operator: what happens in every step. What happens between
// searches is in block_contacts_search.cc.

#include <quoin/contact/block_contacts.h>

#include <algorithm>
#include <cmath>

#include "contact_points.h"

namespace quoin
{
  namespace
  {
    /** Cosine of the angle between edges at which a contact has no area. */
    constexpr double least_cosine = 0.02;
    /** Share of the shorter edge by which edges may overlap that meet without
        having been seen apart. */
    constexpr double first_overlap = 1e-3;

    /**
     * How far [m] the end of an overlap lies beyond the vertex of one edge, by
     * how far @p inside the other edge this vertex lies. Minus the derivative,
     * @p share, by which the end goes with the other edge's vertex, goes from
     * 1 to 0 over twice the @p rounding length [m]; where the vertices coincide
     * and beyond the rounding the end is one of theirs.
     */
    double soft_end(const double inside, const double rounding, double &share)
    {
      if (rounding == 0.)
      {
        share = inside < 0. ? 1. : 0.;
        return std::max(0., -inside);
      }
      const double left = std::max(0., 1. - std::abs(inside) / rounding);
      const double part = 0.5 * left * (3. * left - 2.);
      share             = inside < 0. ? 1. - part : part;
      return std::max(0., -inside) - 0.5 * std::abs(inside) * left * left;
    }
  } // namespace

  std::array<double, 2>
  BlockContacts::normal_between(const Edge &a, const Edge &b, const double lean)
  {
    const double of_a = 0.5 * (1. - lean), of_b = 0.5 * (1. + lean);
    const double x    = of_a * a.tangent[1] - of_b * b.tangent[1];
    const double y    = of_b * b.tangent[0] - of_a * a.tangent[0];
    const double norm = 1. / std::sqrt(x * x + y * y);
    return { norm * x, norm * y };
  }

  bool BlockContacts::geometry(const ContactPair &pair, const Edge &a,
                               const Edge &b, Geometry &result) const
  {
    const double cosine
        = -(a.tangent[0] * b.tangent[0] + a.tangent[1] * b.tangent[1]);
    if (!(cosine > least_cosine))
      return false;
    // Mean direction, and the cosine of half the angle between the edges.
    const double scale = 1. / std::sqrt(2. + 2. * cosine);
    const double t[2]  = { scale * (a.tangent[0] - b.tangent[0]),
                           scale * (a.tangent[1] - b.tangent[1]) };
    const double half  = (1. + cosine) * scale;

    const double x       = b.x - a.x;
    const double y       = b.y - a.y;
    const double along_a = half * a.length;
    const double along_b = half * b.length;
    const double begin_b = x * t[0] + y * t[1]; // b runs backwards from here
    const double end_b   = begin_b - along_b;
    const double ends[2] = { std::max(0., end_b), std::min(along_a, begin_b) };
    const double overlap = ends[1] - ends[0];
    if (!(overlap > 0.))
      return false;
    result.overlap    = overlap;
    result.tangent[0] = t[0];
    result.tangent[1] = t[1];
    result.half       = half;
    result.slope      = (a.tangent[0] * t[1] - a.tangent[1] * t[0]) / half;
    result.begin      = begin_b;
    result.height     = x * t[1] - y * t[0];

    // The length that counts allows for the slip at which a matched joint,
    // whose length does not change, became this contact.
    double length = overlap;
    if (pair.shift != 0.)
    {
      const double shift = shift_left(pair, a, b, t);
      length             = std::max(0., std::min(along_a, begin_b + shift)
                                            - std::max(0., end_b + shift));
    }
    const double fade
        = std::min(1., (cosine - least_cosine) / (1. - least_cosine));
    const double area = 0.5 * length / half * fade
                        * std::min(a.thickness, b.thickness) * 0.5
                        * (a.reference_ratio + b.reference_ratio);

    // By how far the vertex of a lies within b at either end.
    const double inside[2] = { -end_b, begin_b - along_a };
    const double sine
        = std::abs(a.tangent[0] * b.tangent[1] - a.tangent[1] * b.tangent[0]);
    const double parallel
        = pair.was_joint
              ? std::clamp(1.5 - 0.5 * sine / parameters.handover, 0., 1.)
              : 0.;
    result.sideways = (inside[0] > 0. ? a.corner[0] : b.corner[1])
                      * (inside[1] > 0. ? a.corner[1] : b.corner[0]);
    const double rounding = parameters.rounding * std::min(a.length, b.length);
    for (unsigned int k = 0; k < 2; ++k)
    {
      // As soon as a corner is among them the end of the overlap of what was a
      // joint goes over from one vertex to the other within the rounding
      // length.
      const double ca = a.corner[k], cb = b.corner[1 - k];
      const double shift  = ca * (1. - cb) - cb * (1. - ca);
      const double beyond = soft_end(
          inside[k], pair.was_joint ? rounding * std::max(ca, cb) : 0.,
          result.share[k]);
      const double end = k == 0 ? beyond : along_a - beyond;
      result.lower[k]  = end / along_a;
      result.upper[k]  = (begin_b - end) / along_b;
      const double dx  = x + result.upper[k] * b.length * b.tangent[0]
                        - result.lower[k] * a.length * a.tangent[0];
      const double dy = y + result.upper[k] * b.length * b.tangent[1]
                        - result.lower[k] * a.length * a.tangent[1];
      // The edge that a vertex touches gives the normal. Where two vertices
      // pass each other it turns from one edge to the other, unless one of
      // them is no corner: then its edge's normal holds on.
      const double touched = 0.5 * (1. + inside[k] / rounding + shift);
      const double of_b
          = 0.5 * parallel + (1. - parallel) * std::clamp(touched, 0., 1.);
      result.lean[k] = 2. * of_b - 1.;
      // Joints overlap by little against the rounding. Where overlaps may be
      // many times as deep, forces of the turning would be a wall.
      result.turn[k]    = pair.was_joint && touched > 0. && touched < 1.
                              ? (1. - parallel) / rounding
                              : 0.;
      const auto normal = normal_between(a, b, result.lean[k]);
      std::copy(normal.begin(), normal.end(), result.normal[k]);
      result.opening[k] = dx * normal[0] + dy * normal[1];

      result.area[k] = area;
      if (cosine < 1. - 1e-7)
      {
        const double by_a
            = std::clamp(0.5 + 0.5 * inside[k] / rounding, 0., 1.);
        result.area[k]
            *= by_a * recession(cosine, local_edges[a.neighbours[k]], b)
               + (1. - by_a)
                     * recession(cosine, local_edges[b.neighbours[1 - k]], a);
      }
    }
    return true;
  }

  double BlockContacts::recession(const double cosine, const Edge &neighbour,
                                  const Edge &touched)
  {
    const double of_neighbour = -(neighbour.tangent[0] * touched.tangent[0]
                                  + neighbour.tangent[1] * touched.tangent[1]);
    if (of_neighbour <= cosine)
      return 1.;
    const double ratio = cosine / of_neighbour;
    return ratio * ratio * ratio * ratio * ratio * ratio;
  }

  double BlockContacts::shift_left(const ContactPair &pair, const Edge &a,
                                   const Edge &b, const double *t)
  {
    double slipped = 0.;
    if (pair.active)
    {
      const double normal[2] = { t[1], -t[0] };
      slipped = std::abs(slip(pair.points[0], a, b, normal) - pair.shift_start);
    }
    return std::copysign(std::max(0., std::abs(pair.shift) - 0.5 * slipped),
                         pair.shift);
  }

  double BlockContacts::slip(const ContactPoint &point, const Edge &a,
                             const Edge &b, const double *normal)
  {
    const double la = point.anchor_lower * a.length;
    const double lb = point.anchor_upper * b.length;
    const double x  = b.x - a.x + lb * b.tangent[0] - la * a.tangent[0];
    const double y  = b.y - a.y + lb * b.tangent[1] - la * a.tangent[1];
    return point.slip_offset + x * normal[1] - y * normal[0];
  }

  void BlockContacts::gather(const State<2> &state)
  {
    reach->update_ghosts(state.nodes.data(), ghost_nodes.data());
    const auto place = [](const NodeRecord<2> &node) {
      return NodeVector<2>{ { node.X[0] + node.u[0], node.X[1] + node.u[1] } };
    };
    NodeVector<2> *to = position.data();
    for (const unsigned int i : compact_own)
      *to++ = place(state.nodes[i]);
    for (const NodeRecord<2> &node : ghost_nodes)
      *to++ = place(node);

    for (unsigned int e = 0; e < local_edges.size(); ++e)
    {
      Edge &edge      = local_edges[e];
      const double *p = position[edge.nodes[0]].v;
      const double *q = position[edge.nodes[1]].v;
      const double dx = q[0] - p[0], dy = q[1] - p[1];
      edge.length          = std::sqrt(dx * dx + dy * dy);
      const double inverse = 1. / edge.length;
      edge.x               = p[0];
      edge.y               = p[1];
      edge.tangent[0]      = inverse * dx;
      edge.tangent[1]      = inverse * dy;
      edge.reference_ratio = inverse * reference_lengths[e];
    }
  }

  void BlockContacts::gather_velocities(const NodeVector<2> *velocity)
  {
    reach->update_ghosts(velocity, ghost_velocity.data());
    NodeVector<2> *to = compact_velocity.data();
    for (const unsigned int i : compact_own)
      *to++ = velocity[i];
    std::copy(ghost_velocity.begin(), ghost_velocity.end(), to);
  }

  void BlockContacts::scatter(AlignedArray<NodeVector<2>> &from,
                              NodeVector<2> *to) const
  {
    for (unsigned int j = 0; j < compact_own.size(); ++j)
      for (unsigned int d = 0; d < 2; ++d)
        to[compact_own[j]].v[d] += from[j].v[d];
    std::fill(from.begin(), from.end(), NodeVector<2>{ { 0., 0. } });
  }

  // In line: sums stay in registers.
  inline DEAL_II_ALWAYS_INLINE void
  BlockContacts::add_point_forces(const unsigned int i, const unsigned int k,
                                  const Geometry &g, ContactState &contacts,
                                  const double viscous_beta, const bool damps,
                                  Losses &losses)
  {
    ContactPair &pair    = contacts.pairs[i];
    ContactPoint &point  = pair.points[k];
    const Edge &a        = local_edges[pair_edges[i][0]];
    const Edge &b        = local_edges[pair_edges[i][1]];
    const double *normal = g.normal[k];
    // What crushed has closed for good and is not overlap.
    const double deep = std::min(0., point.plastic_opening) - g.opening[k];
    if (deep > pair_depth[i] && g.overlap > deep)
      note_depth(i, deep);
    // Kinks of the law within a step: what the trapezoidal work of a contact
    // that closes or opens there has beyond its energy.
    const double pulled_before = point.area * point.normal_traction;
    const double gap_before    = open_gap(point);

    double opening     = g.opening[k];
    const double depth = point.plastic_opening - opening;
    double sideways    = 0.;
    if (depth > g.overlap)
      sideways = g.sideways * (depth - g.overlap * g.overlap / depth);
    opening += sideways;
    const double slip_now     = slip(point, a, b, normal);
    const double sigma_before = point.normal_traction;
    const double tau_before   = point.shear_traction;

    ContactStep step;
    std::array<double, 2> stiffness;
    with_law(pair.set,
             [&, opening](const auto &law)
             {
               step      = advance_contact(law, point, opening, slip_now);
               stiffness = law.stiffness_at(point.normal_traction);
             });
    // What an heir does as it comes, with no area, is not its own work.
    const double mean_area
        = point.area > 0. ? 0.5 * (g.area[k] + point.area) * pair_share[i] : 0.;
    losses.friction += mean_area * step.lost.friction;
    losses.fracture += mean_area * step.lost.fracture;
    losses.crushing += mean_area * step.lost.crushing;
    if (!pair.was_joint
        && (point.lean != g.lean[k] || point.sideways != sideways))
    {
      const auto [x, y] = motion_of_frame(a, b, g, k, point, slip_now);
      losses.contact -= 0.5 * mean_area
                        * ((sigma_before + point.normal_traction)
                               * (x + sideways - point.sideways)
                           + (tau_before + point.shear_traction) * y);
    }
    point.lean     = g.lean[k];
    point.sideways = sideways;
    if (step.flows)
    {
      // Anchors behind would turn rotation into slip.
      point.anchor_lower = g.lower[k];
      point.anchor_upper = g.upper[k];
      point.slip_offset += slip_now - slip(point, a, b, normal);
    }
    // What the trapezoidal work of a spring with changing area leaves over
    // from the change of its energy.
    losses.contact += pair_share[i] * (point.area - g.area[k]) * step.carried;
    point.area    = g.area[k];
    point.opening = opening;

    const double sigma = g.area[k] * point.normal_traction;
    const double tau   = g.area[k] * point.shear_traction;
    losses.contact += 0.5 * pair_share[i] * (pulled_before + sigma)
                      * (open_gap(point) - gap_before);
    if (sigma != 0. || tau != 0.)
      add_tractions(a, b, g, k, point, sigma, tau, compact_force.data());
    if (viscous_beta > 0. && point.state != JointState::open
        && point.state != JointState::slipping)
      add_viscous_forces(a, b, g, k, viscous_beta, stiffness);
    if (damps && point.normal_traction < 0.)
      note_dashpot(i, k, g, { { opening, slip_now } }, stiffness);
  }

  double BlockContacts::open_gap(const ContactPoint &point)
  {
    return point.normal_traction == 0. && std::isfinite(point.opening)
               ? point.opening - point.plastic_opening
               : 0.;
  }

  std::array<double, 2> BlockContacts::motion_of_frame(
      const Edge &a, const Edge &b, const Geometry &g, const unsigned int k,
      const ContactPoint &point, const double slip_now)
  {
    const auto [x, y]      = normal_between(a, b, point.lean);
    const double before[2] = { x, y };
    const double la = g.lower[k] * a.length, lb = g.upper[k] * b.length;
    const double dx = b.x - a.x + lb * b.tangent[0] - la * a.tangent[0];
    const double dy = b.y - a.y + lb * b.tangent[1] - la * a.tangent[1];
    return { g.opening[k] - (dx * x + dy * y),
             slip_now - slip(point, a, b, before) };
  }

  void BlockContacts::add_tractions(const Edge &a, const Edge &b,
                                    const Geometry &g, const unsigned int k,
                                    const ContactPoint &point,
                                    const double sigma, const double tau,
                                    NodeVector<2> *force)
  {
    const double *normal = g.normal[k], *t = g.tangent;
    const double f[2] = { tau * normal[1], -tau * normal[0] };
    spread(a, b, point.anchor_lower, point.anchor_upper, f, force);

    // theory.md, "General contacts": the differential of sigma u_n + tau u_s
    // by the place of b, the rotations and the lengths of both edges.
    const double cosine = normal[0] * t[1] - normal[1] * t[0];
    const double sine   = normal[0] * t[0] + normal[1] * t[1];
    const double rise   = g.slope * g.half;
    const double end    = g.lower[k] * g.half * a.length;
    const double lag    = g.begin - 2. * end;
    const double height = g.height + g.slope * lag;
    const double pull   = 2. * g.slope * cosine * sigma;
    const double side   = k == 0 ? -1. : 1.;

    const double la = point.anchor_lower * a.length;
    const double lb = point.anchor_upper * b.length;
    const double across
        = (b.x - a.x + lb * b.tangent[0] - la * a.tangent[0]) * normal[0]
          + (b.y - a.y + lb * b.tangent[1] - la * a.tangent[1]) * normal[1];
    const double by_turn
        = cosine * cosine * (tau * across - sigma * height * sine);
    const double by_slope = sigma * cosine * lag + by_turn * g.lean[k];
    const double by_inside
        = by_turn * g.slope * g.turn[k] - side * pull * g.share[k];

    const double along   = 0.5 * pull + side * by_inside;
    const double move[2] = { sigma * cosine * t[1] + along * t[0],
                             along * t[1] - sigma * cosine * t[0] };
    const double turn
        = tau * across + move[0] * (b.y - a.y) - move[1] * (b.x - a.x);
    double bend      = -by_slope / (g.half * g.half);
    double stretch_a = 0., stretch_b = 0.;
    if (k == 0)
    {
      bend += by_inside * b.length * rise;
      stretch_b = by_inside * g.half;
    }
    else
    {
      bend -= (by_inside + pull) * a.length * rise;
      stretch_a = -(by_inside + pull) * g.half;
    }

    const double turn_a = 0.5 * (turn + bend) / a.length;
    const double turn_b = 0.5 * (turn - bend) / b.length;
    const double end_a[2]
        = { stretch_a * a.tangent[0] - turn_a * a.tangent[1],
            stretch_a * a.tangent[1] + turn_a * a.tangent[0] };
    const double end_b[2]
        = { stretch_b * b.tangent[0] - turn_b * b.tangent[1],
            stretch_b * b.tangent[1] + turn_b * b.tangent[0] };
    for (unsigned int d = 0; d < 2; ++d)
    {
      force[a.nodes[0]].v[d] += end_a[d] + move[d];
      force[a.nodes[1]].v[d] -= end_a[d];
      force[b.nodes[0]].v[d] += end_b[d] - move[d];
      force[b.nodes[1]].v[d] -= end_b[d];
    }
  }

  void BlockContacts::add_viscous_forces(const Edge &a, const Edge &b,
                                         const Geometry &g,
                                         const unsigned int k,
                                         const double beta,
                                         const std::array<double, 2> &stiffness)
  {
    const double *normal = g.normal[k];
    double rate[2];
    relative_velocity(a, b, g.lower[k], g.upper[k], rate);
    const double wn = beta * g.area[k] * stiffness[0];
    const double ws = beta * g.area[k] * stiffness[1];
    const double vn = wn * (rate[0] * normal[0] + rate[1] * normal[1]);
    const double vs = ws * (rate[0] * normal[1] - rate[1] * normal[0]);
    const double f[2]
        = { vn * normal[0] + vs * normal[1], vn * normal[1] - vs * normal[0] };
    spread(a, b, g.lower[k], g.upper[k], f, compact_viscous.data());
  }

  void BlockContacts::add_forces(const StepContext &step, State<2> &state,
                                 const NodeForces<2> &forces)
  {
    ContactState &contacts    = state.get<ContactState>();
    const double viscous_beta = forces.viscous ? step.stiffness_damping : 0.;
    const bool damps          = forces.viscous && has_dashpots();
    if (viscous_beta > 0. || damps)
      gather_velocities(state.velocity.data());
    if (damps)
    {
      dashpots.clear();
      dashpot_points.clear();
    }
    Losses losses;
    updates += contacts.pairs.size();
    begin_contacts(contacts);
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
    {
      ContactPair &pair = contacts.pairs[i];
      if (!pair.active)
        continue;
      Geometry g;
      if (!geometry(pair, local_edges[pair_edges[i][0]],
                    local_edges[pair_edges[i][1]], g))
      {
        losses.contact += pair_share[i] * release(pair);
        pair.was_open = 0;
        continue;
      }
      for (unsigned int k = 0; k < 2; ++k)
        add_point_forces(i, k, g, contacts, viscous_beta, damps, losses);
    }
    if (damps)
      add_dashpot_forces(contacts);
    state.energy.friction += losses.friction;
    state.energy.fracture += losses.fracture;
    state.energy.crushing += losses.crushing;
    state.energy.contact += losses.contact;

    scatter(compact_force, forces.force);
    if (viscous_beta > 0. || damps)
      scatter(compact_viscous, forces.viscous);
  }

  void BlockContacts::spread(const Edge &a, const Edge &b, const double lower,
                             const double upper, const double *f,
                             NodeVector<2> *force)
  {
    for (unsigned int d = 0; d < 2; ++d)
    {
      force[a.nodes[0]].v[d] += (1. - lower) * f[d];
      force[a.nodes[1]].v[d] += lower * f[d];
      force[b.nodes[0]].v[d] -= (1. - upper) * f[d];
      force[b.nodes[1]].v[d] -= upper * f[d];
    }
  }

  void BlockContacts::relative_velocity(const Edge &a, const Edge &b,
                                        const double lower, const double upper,
                                        double *rate) const
  {
    const auto &v = compact_velocity;
    for (unsigned int d = 0; d < 2; ++d)
      rate[d] = (1. - upper) * v[b.nodes[0]].v[d] + upper * v[b.nodes[1]].v[d]
                - (1. - lower) * v[a.nodes[0]].v[d]
                - lower * v[a.nodes[1]].v[d];
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

  void BlockContacts::begin_contacts(ContactState &contacts)
  {
    // Before any pair is brought to the present, so that heirs go on from the
    // same past as those they follow, whatever the order of the pairs.
    copies.update(contacts.pairs);
    new_contacts.clear();
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
    {
      ContactPair &pair = contacts.pairs[i];
      if (pair.active)
        continue;
      Geometry g;
      if (!geometry(pair, local_edges[pair_edges[i][0]],
                    local_edges[pair_edges[i][1]], g))
        pair.was_open = 0;
      else if (begin_contact(contacts, i, g))
        new_contacts.push_back(i);
      else
        for (unsigned int k = 0; k < 2; ++k)
          pair.points[k].opening = g.opening[k];
    }
    for (const unsigned int i : new_contacts)
      contacts.pairs[i].active = 1;
  }

  bool BlockContacts::begin_contact(ContactState &contacts,
                                    const unsigned int i, const Geometry &g)
  {
    ContactPair &pair    = contacts.pairs[i];
    const double opening = std::min(g.opening[0], g.opening[1]);
    pair.was_open        = pair.was_open || opening >= 0.;
    if (opening >= 0. && !dilates)
      return false;
    unsigned int set = pair.set;
    ContactPoint inherited;
    double deepest     = 0.;
    const bool is_heir = find_parent(contacts, i, set, inherited, deepest);
    if (opening >= inherited.plastic_opening
        || opening <= std::min(0., inherited.plastic_opening) - pair_depth[i])
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
      point.slip_offset = inherited.slip_offset
                          - slip(point, local_edges[pair_edges[i][0]],
                                 local_edges[pair_edges[i][1]], g.normal[k]);
    }
    return true;
  }

  bool BlockContacts::vertex_is_inside(const unsigned int i, const Geometry &g,
                                       const unsigned int k) const
  {
    const Edge &a        = local_edges[pair_edges[i][0]];
    const Edge &b        = local_edges[pair_edges[i][1]];
    const bool is_of_a   = g.share[k] < 0.5;
    const Edge &touched  = is_of_a ? b : a;
    const double *vertex = position[is_of_a ? a.nodes[k] : b.nodes[1 - k]].v;
    for (const unsigned int e : touched.neighbours)
    {
      const Edge &next     = local_edges[e];
      const bool is_before = &next == &local_edges[touched.neighbours[0]];
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
      const auto &beside = local_edges[pair_edges[i][1 - side]].neighbours;
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
        const Edge &a = local_edges[pair_edges[q][0]];
        const Edge &b = local_edges[pair_edges[q][1]];
        if (!geometry(parent, a, b, g))
          continue;
        const double vertex = other == beside[1] ? 0. : 1.;
        const double *place = at == 0 ? g.lower : g.upper;
        const unsigned int k
            = std::abs(place[0] - vertex) <= std::abs(place[1] - vertex) ? 0
                                                                         : 1;
        deepest               = std::min(g.opening[0], g.opening[1]);
        set                   = parent.set;
        inherited             = parent.points[k];
        inherited.slip_offset = slip(inherited, a, b, g.normal[k]);
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
                   energy += pair_share[i] * point.area
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
          n += pair_share[i];
    return n;
  }

  bool BlockContacts::contact(const ContactState &contacts,
                              const unsigned int i, Contact &result) const
  {
    const ContactPair &pair = contacts.pairs[i];
    const Edge &a           = local_edges[pair_edges[i][0]];
    const Edge &b           = local_edges[pair_edges[i][1]];
    Geometry g;
    if (!pair.active || !geometry(pair, a, b, g))
      return false;
    result.set   = pair.set;
    result.share = pair_share[i];
    for (unsigned int k = 0; k < 2; ++k)
    {
      const double la = g.lower[k] * a.length, lb = g.upper[k] * b.length;
      result.lower[k] = { a.x + la * a.tangent[0], a.y + la * a.tangent[1] };
      result.upper[k] = { b.x + lb * b.tangent[0], b.y + lb * b.tangent[1] };
      const ContactPoint &point = pair.points[k];
      const double sigma        = point.area * point.normal_traction;
      const double tau          = point.area * point.shear_traction;
      const auto &[nx, ny]      = g.normal[k];
      result.force[k]     = { sigma * nx + tau * ny, sigma * ny - tau * nx };
      const auto &[p, q]  = edges[pair.lower].points;
      result.reference[k] = { p[0] + g.lower[k] * (q[0] - p[0]),
                              p[1] + g.lower[k] * (q[1] - p[1]) };
      result.opening[k]   = g.opening[k];
      result.slip[k]      = slip(pair.points[k], a, b, g.normal[k]);
    }
    return true;
  }

  bool BlockContacts::end_forces(const ContactState &contacts,
                                 const unsigned int i, EndForces &result) const
  {
    const ContactPair &pair = contacts.pairs[i];
    Edge a = local_edges[pair_edges[i][0]], b = local_edges[pair_edges[i][1]];
    Geometry g;
    if (!pair.active || !geometry(pair, a, b, g))
      return false;
    a.nodes[0] = 0;
    a.nodes[1] = 1;
    b.nodes[0] = 2;
    b.nodes[1] = 3;
    NodeVector<2> force[4]{};
    for (unsigned int k = 0; k < 2; ++k)
    {
      const ContactPoint &point = pair.points[k];
      add_tractions(a, b, g, k, point, point.area * point.normal_traction,
                    point.area * point.shear_traction, force);
    }
    for (const Edge *edge : { &a, &b })
      for (unsigned int end = 0; end < 2; ++end)
      {
        const unsigned int n  = edge->nodes[end];
        const double distance = end == 0 ? 0. : edge->length;
        result.place[n]       = { edge->x + distance * edge->tangent[0],
                                  edge->y + distance * edge->tangent[1] };
        result.force[n]       = { force[n].v[0], force[n].v[1] };
      }
    result.share = pair_share[i];
    return true;
  }

  bool BlockContacts::is_own(const ContactState &contacts,
                             const unsigned int pair) const
  {
    return edges.is_own(contacts.pairs[pair].lower);
  }
} // namespace quoin
