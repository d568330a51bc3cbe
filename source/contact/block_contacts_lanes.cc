// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What the contact operator does in every step, for several pairs at once.

#include <algorithm>
#include <limits>

#include "contact_pack.h"
#include "contact_pairs.h"

namespace quoin
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** By how much contacts without traction are open [m]; less than 0 where
        one that begins overlaps already. */
    template <int lanes>
    QUOIN_INLINE typename Lanes<lanes>::Value
    open_gap(const typename Lanes<lanes>::Value &sigma,
             const typename Lanes<lanes>::Value &opening,
             const typename Lanes<lanes>::Value &plastic_opening)
    {
      return ((sigma == 0.) & (opening < infinity))
                 ? opening - plastic_opening
                 : typename Lanes<lanes>::Value{};
    }
  } // namespace

  void BlockContacts::gather(const State<2> &state)
  {
    reach->update_ghosts(state.nodes.data(), ghost_nodes.data());
    const auto place = [](const NodeRecord<2> &node)
    {
      return dealii::Tensor<1, 2>(
          { node.X[0] + node.u[0], node.X[1] + node.u[1] });
    };
    dealii::Tensor<1, 2> *to = position.data();
    for (const unsigned int i : compact_own)
      *to++ = place(state.nodes[i]);
    for (const NodeRecord<2> &node : ghost_nodes)
      *to++ = place(node);

    using L = Lanes<native_lanes>;
    using F = LaneFunctions<native_lanes>;
    for (unsigned int e = 0; e < edge_numbers.size(); e += native_lanes)
    {
      std::uint32_t nodes[2][native_lanes];
      for (unsigned int l = 0; l < native_lanes; ++l)
        for (unsigned int k = 0; k < 2; ++k)
          nodes[k][l] = edge_links[e + l].nodes[k];
      F::Value x[2], y[2];
      for (unsigned int k = 0; k < 2; ++k)
        L::load(reinterpret_cast<const char *>(position.data()),
                sizeof(dealii::Tensor<1, 2>), nodes[k], x[k], y[k]);
      const F::Value dx = x[1] - x[0], dy = y[1] - y[0];
      const F::Value length  = F::square_root(dx * dx + dy * dy);
      const F::Value inverse = 1. / length;
      const F::Value ratio   = inverse * F::load(&reference_lengths[e]);
      L::store_four([&](const int l) { return &local_edges[e + l].x; },
                    { x[0], y[0], inverse * dx, inverse * dy });
      L::store_four([&](const int l) { return &local_edges[e + l].length; },
                    { length, inverse, F::load(&edge_thickness[e]), ratio });
    }
  }

  template <int lanes>
  void BlockContacts::begin_contacts(ContactState &contacts)
  {
    // Before any pair is brought to the present, so that heirs go on from the
    // same past as those they follow, whatever the order of the pairs.
    copies.update(contacts.pairs);
    const unsigned int n_pairs = contacts.pairs.size();
    active_pairs.resize(n_pairs + 1);
    idle_pairs.resize(n_pairs + 1);
    unsigned int n_active = 0, n_idle = 0;
    for (unsigned int i = 0; i < n_pairs; i += lanes)
    {
      PairMark *marks   = &contacts.marks[i];
      unsigned int idle = 0, overlap = 0;
      for (int l = 0; l < lanes; ++l)
        idle |= unsigned(marks[l] != PairMark::active) << l;
      if (idle != 0)
      {
        std::uint32_t ea[lanes], eb[lanes];
        for (int l = 0; l < lanes; ++l)
        {
          ea[l] = pair_edges[i + l][0];
          eb[l] = pair_edges[i + l][1];
        }
        EdgeLanes<lanes> a, b;
        load_edges(ea, a);
        load_edges(eb, b);
        overlap = idle
                  & LaneFunctions<lanes>::set_lanes(
                      PairFunctions<lanes>::may_overlap(a, b));
      }
      const unsigned int n = std::min<unsigned int>(lanes, n_pairs - i);
      for (unsigned int l = 0; l < n; ++l)
      {
        active_pairs[n_active] = idle_pairs[n_idle] = i + l;
        n_active += ~idle >> l & 1;
        n_idle += overlap >> l & 1;
        if (marks[l] == PairMark::open && (~overlap >> l & 1))
        {
          marks[l]                       = PairMark::unseen;
          contacts.pairs[i + l].was_open = 0;
        }
      }
    }
    active_pairs.resize(n_active);
    new_contacts.clear();
    for (unsigned int j = 0; j < n_idle; j += lanes)
      look_at_idle<lanes>(&idle_pairs[j],
                          std::min<unsigned int>(lanes, n_idle - j), contacts);
    for (const unsigned int i : new_contacts)
    {
      contacts.pairs[i].active = 1;
      contacts.marks[i]        = PairMark::active;
      active_pairs.push_back(i);
    }
  }

  template <int lanes>
  void BlockContacts::look_at_idle(const unsigned int *idle,
                                   const unsigned int n, ContactState &contacts)
  {
    using F = LaneFunctions<lanes>;
    std::uint32_t ea[lanes], eb[lanes];
    for (unsigned int l = 0; l < lanes; ++l)
    {
      const auto &pair = pair_edges[idle[std::min(l, n - 1)]];
      ea[l]            = pair[0];
      eb[l]            = pair[1];
    }
    EdgeLanes<lanes> a, b;
    load_edges(ea, a);
    load_edges(eb, b);
    // Areas do not count.
    PairLanes<lanes> pairs{};
    PairGeometry<lanes> g;
    const unsigned int found
        = F::set_lanes(find_geometry(pairs, ea, a, eb, b, g));
    if (found == 0)
      g.opening[0] = g.opening[1] = typename F::Value{};
    alignas(64) double opening[2][lanes];
    for (unsigned int k = 0; k < 2; ++k)
      F::store(opening[k], g.opening[k]);

    for (unsigned int l = 0; l < n; ++l)
    {
      const unsigned int i = idle[l];
      ContactPair &pair    = contacts.pairs[i];
      PairMark &mark       = contacts.marks[i];
      const bool is_there  = found >> l & 1;
      const bool is_open
          = is_there && std::min(opening[0][l], opening[1][l]) >= 0.;
      if (is_there ? is_open && mark != PairMark::open : mark == PairMark::open)
      {
        mark          = is_open ? PairMark::open : PairMark::unseen;
        pair.was_open = is_open;
      }
      if (!is_there)
        continue;
      Geometry own;
      if ((!is_open || dilates) && geometry(pair, i, own)
          && begin_contact(contacts, i, own))
        new_contacts.push_back(i);
      else
        for (unsigned int k = 0; k < 2; ++k)
          pair.points[k].opening = opening[k][l];
    }
  }

  template <int lanes>
  void BlockContacts::add_forces_in_lanes(ContactState &contacts,
                                          const double viscous_beta,
                                          const bool damps, Losses &losses)
  {
    begin_contacts<lanes>(contacts);
    const auto add
        = [&](const unsigned int set, const std::vector<unsigned int> &active)
    {
      std::visit(
          [&](const auto &law)
          {
            add_forces_under<lanes>(law, active, contacts, viscous_beta, damps,
                                    losses);
          },
          laws[set]);
    };
    if (laws.size() == 1)
    {
      add(0, active_pairs);
      return;
    }
    pairs_of_set.resize(laws.size());
    for (std::vector<unsigned int> &list : pairs_of_set)
      list.clear();
    for (const unsigned int i : active_pairs)
      pairs_of_set[contacts.pairs[i].set].push_back(i);
    for (unsigned int set = 0; set < laws.size(); ++set)
      add(set, pairs_of_set[set]);
  }

  template <int lanes, typename Law>
  void BlockContacts::add_forces_under(const Law &law,
                                       const std::vector<unsigned int> &active,
                                       ContactState &contacts,
                                       const double viscous_beta,
                                       const bool damps, Losses &losses)
  {
    using L     = Lanes<lanes>;
    using F     = LaneFunctions<lanes>;
    using P     = PairFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;

    const typename ContactPack<Law, lanes>::Laws laws_in_lanes(law);
    ContactPack<Law, lanes> pack;
    const Value none{};
    DissipationLanes<lanes> lost;
    Value lost_by_contact{};
    const unsigned int n_active = active.size();
    for (unsigned int first = 0; first < n_active; first += lanes)
    {
      // Lanes beyond the last pair repeat it.
      const unsigned int n   = std::min<unsigned int>(lanes, n_active - first);
      const unsigned int all = (1U << n) - 1;
      std::uint32_t pair[lanes], ea[lanes], eb[lanes];
      for (unsigned int l = 0; l < lanes; ++l)
      {
        pair[l] = active[first + std::min(l, n - 1)];
        ea[l]   = pair_edges[pair[l]][0];
        eb[l]   = pair_edges[pair[l]][1];
      }
      EdgeLanes<lanes> a, b;
      load_edges(ea, a);
      load_edges(eb, b);
      ContactPair *pairs = contacts.pairs.data();
      // Those of the pack after the next one: active pairs lie anywhere.
      for (unsigned int j = first + 2 * lanes;
           j < std::min(n_active, first + 3 * lanes); ++j)
        for (unsigned int line = 0; line < sizeof(ContactPair); line += 64)
          __builtin_prefetch(
              reinterpret_cast<const char *>(pairs + active[j]) + line, 1);
      PairLanes<lanes> at;
      L::load(reinterpret_cast<const char *>(&pairs->shift),
              sizeof(ContactPair), pair, at.shift, at.shift_start);
      at.was_joint = F::each([&](const int l) -> double
                             { return pairs[pair[l]].was_joint; })
                     != 0.;
      at.active             = none == none;
      const Bits is_general = at.was_joint == Bits{};
      Value share, depth_limit;
      L::load(reinterpret_cast<const char *>(pair_weights.data()),
              sizeof(PairWeight), pair, share, depth_limit);

      pack.load(pairs, pair, 0);
      at.anchor = pack.anchor;
      PairGeometry<lanes> g;
      const unsigned int found
          = F::set_lanes(find_geometry(at, ea, a, eb, b, g)) & all;
      const Bits present
          = F::each([&](const int l) { return found >> l & 1 ? 1. : 0.; })
            != 0.;
      TractionLanes<lanes> forces, viscous;
      for (unsigned int k = 0; k < 2 && found != 0; ++k)
      {
        if (k == 1)
          pack.load(pairs, pair, 1);
        if (found != (1U << lanes) - 1)
          pack.keep(found);
        const Value(&normal)[2] = g.normal[k];
        // What crushed has closed for good and is not overlap.
        const Value deep = F::minimum(none, pack.plastic_before) - g.opening[k];
        const unsigned int too_deep
            = F::set_lanes(present & (deep > depth_limit) & (g.overlap > deep));
        for (unsigned int l = 0; l < n && too_deep >> l != 0; ++l)
          if (too_deep >> l & 1)
            note_depth(pair[l], F::at(deep, l));

        const Value depth = pack.plastic_before - g.opening[k];
        Value sideways{};
        const Bits is_deeper = present & (depth > g.overlap);
        if (F::any(is_deeper))
          sideways = is_deeper
                         ? g.sideways * (depth - g.overlap * g.overlap / depth)
                         : none;
        const Value opening  = g.opening[k] + sideways;
        const Value slip_now = P::slip(pack.anchor, a, b, normal);

        // What an heir does as it comes, with no area, is not its own work.
        const Value mean_area
            = (present & (pack.area_before > 0.))
                  ? 0.5 * (g.area[k] + pack.area_before) * share
                  : none;
        pack.advance(law, laws_in_lanes, present, opening, slip_now, mean_area,
                     lost);
        const Value sigma = g.area[k] * pack.sigma;
        const Value tau   = g.area[k] * pack.tau;

        // What the trapezoidal work of a spring with changing area leaves over
        // from the change of its energy.
        Value of_contact
            = share * (pack.area_before - g.area[k]) * pack.carried(law);
        // Kinks of the law within a step: what the trapezoidal work of a
        // contact that closes or opens there has beyond its energy.
        const Value gap_before = open_gap<lanes>(
            pack.sigma_before, pack.opening_before, pack.plastic_before);
        const Value gap_now
            = open_gap<lanes>(pack.sigma, opening, pack.plastic_opening());
        of_contact += 0.5 * share
                      * (pack.area_before * pack.sigma_before + sigma)
                      * (gap_now - gap_before);
        const Bits turns = present & is_general
                           & ((pack.lean_before != g.lean[k])
                              | (pack.sideways_before != sideways));
        if (F::any(turns))
        {
          // What of the opening and of the slip came since the last step by
          // the turning of the normal from one edge to the other.
          Value before[2], d[2];
          P::normal_between(a, b, g.tangent, pack.lean_before, before);
          P::gap(a, b, g.lower[k], g.upper[k], d);
          const Value x = opening - (d[0] * before[0] + d[1] * before[1])
                          - pack.sideways_before;
          const Value y = slip_now - P::slip(pack.anchor, a, b, before);
          of_contact -= turns ? 0.5 * mean_area
                                    * ((pack.sigma_before + pack.sigma) * x
                                       + (pack.tau_before + pack.tau) * y)
                              : none;
        }
        lost_by_contact += present ? of_contact : none;

        const Bits flows     = present & pack.flows();
        const bool any_flows = F::any(flows);
        if (any_flows)
        {
          // Anchors behind would turn rotation into slip.
          pack.anchor.lower   = flows ? g.lower[k] : pack.anchor.lower;
          pack.anchor.upper   = flows ? g.upper[k] : pack.anchor.upper;
          const Value counted = P::slip(pack.anchor, a, b, normal);
          pack.anchor.slip_offset += flows ? slip_now - counted : none;
        }
        pack.store(g.area[k], opening, g.lean[k], sideways, any_flows);

        P::add_tractions(a, b, g, k, pack.anchor, sigma, tau, forces);
        if (viscous_beta == 0. && !damps)
          continue;
        Value stiffness[2];
        pack.stiffness(law, stiffness);
        if (viscous_beta > 0.)
        {
          Value rate[2];
          relative_velocity<lanes>(ea, eb, g.lower[k], g.upper[k], rate);
          const Value w = flows ? none : viscous_beta * g.area[k];
          const Value vn
              = w * stiffness[0] * (rate[0] * normal[0] + rate[1] * normal[1]);
          const Value vs
              = w * stiffness[1] * (rate[0] * normal[1] - rate[1] * normal[0]);
          const Value f[2] = { vn * normal[0] + vs * normal[1],
                               vn * normal[1] - vs * normal[0] };
          P::spread(g.lower[k], g.upper[k], f, viscous);
        }
        for (unsigned int l = 0; l < n && damps; ++l)
          if ((found >> l & 1) && F::at(pack.sigma, l) < 0.)
            note_dashpot(
                { pair[l],
                  k,
                  F::at(g.area[k], l),
                  F::at(g.lower[k], l),
                  F::at(g.upper[k], l),
                  { F::at(normal[0], l), F::at(normal[1], l) },
                  { F::at(opening, l), F::at(slip_now, l) },
                  { F::at(stiffness[0], l), F::at(stiffness[1], l) } });
      }
      add_to_ends(P::end_forces(a, b, forces), ea, eb, found,
                  compact_force.data());
      if (viscous_beta > 0.)
        add_to_ends(P::end_forces(a, b, viscous), ea, eb, found,
                    compact_viscous.data());
      for (unsigned int l = 0; l < n && found != all; ++l)
        if (~found >> l & 1)
        {
          losses.contact
              += pair_weights[pair[l]].share * release(pairs[pair[l]]);
          pairs[pair[l]].was_open = 0;
          contacts.marks[pair[l]] = PairMark::unseen;
        }
    }
    losses.friction += F::sum(lost.friction);
    losses.fracture += F::sum(lost.fracture);
    losses.crushing += F::sum(lost.crushing);
    losses.contact += F::sum(lost_by_contact);
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
    if (contacts.marks.empty())
      make_marks(contacts);
    updates += contacts.pairs.size();
    Losses losses;
    switch (n_lanes)
    {
    case 1:
      add_forces_in_lanes<1>(contacts, viscous_beta, damps, losses);
      break;
    case 4:
      add_forces_in_lanes<4>(contacts, viscous_beta, damps, losses);
      break;
    default:
      add_forces_in_lanes<8>(contacts, viscous_beta, damps, losses);
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

  void BlockContacts::make_marks(ContactState &contacts) const
  {
    // Lanes beyond the last pair are none that begins.
    contacts.marks.assign((contacts.pairs.size() + most_lanes) / most_lanes
                              * most_lanes,
                          PairMark::active);
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
      if (!contacts.pairs[i].active)
        contacts.marks[i]
            = contacts.pairs[i].was_open ? PairMark::open : PairMark::unseen;
  }
} // namespace quoin
