// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/base/vector_range.h>
#include <quoin/base/wall_clock.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/contact/joint_handover.h>
#include <quoin/contact_geometry/edge_lanes.h>
#include <quoin/joint_elements/dashpot_bounds.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/operators/archive.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "contact_pack.h"
#include "contact_points.h"
#include "pair_marks.h"

namespace quoin
{
  namespace
  {
    /** Share of the shorter edge by which edges may overlap that meet without
        having been seen apart. */
    constexpr double first_overlap = 1e-3;

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

    /** The largest square among vectors on all ranks, and the box around them.
     */
    struct Spread
    {
      double square = 0.;
      VectorRange range;

      void take(const dealii::Tensor<1, 2> &vector)
      {
        square = std::max(square, vector.norm_square());
        for (unsigned int d = 0; d < 2; ++d)
          range.take(vector[d], d);
      }
      /** A bound of the difference of two of them: what all share is none. */
      double difference() const
      {
        return std::min(2. * std::sqrt(square), range.diagonal());
      }
    };

    /** What ranks tell each other when they look at the motions. */
    struct Look
    {
      Spread moved, speed;
      double changed = 0.; /**< 1: joints go, or blocks have gone */
      double deepest = 0.; /**< overlap by that at which the run ends */

      void collect(const MPI_Comm communicator)
      {
        MPI_Allreduce(MPI_IN_PLACE, this, sizeof(Look) / sizeof(double),
                      MPI_DOUBLE, MPI_MAX, communicator);
      }
    };
  } // namespace

  BlockContacts::BlockContacts(const NodeMap<2> &node_map,
                               const MatchedJoints &joints,
                               const ContactModel &model)
    : node_map(node_map), joints(joints), exchange(node_map.exchange()),
      edges(node_map), parameters(model.parameters), thickness(model.thickness),
      near(node_map, edges, parameters, thickness),
      contact_laws(model.sets, model.materials, model.material_of_group),
      all_dashpots(near, contact_laws),
      search(node_map, edges, near, contact_laws, parameters.skin),
      n_lanes(model.n_lanes)
  {
  }

  void BlockContacts::prepare(State<2> &state) const
  {
    state.add<ContactState>();
  }

  void BlockContacts::update(const StepContext &step, State<2> &state)
  {
    ContactState &contacts = state.get<ContactState>();
    if (bound_search != contacts.n_searches)
      bind(contacts);
    if (contacts.next_check != ContactState::never
        && (state.step >= contacts.next_check || moves_faster(state, step.dt)))
      check(state, step.dt);
    near.moving_edges().gather(state);
  }

  bool BlockContacts::moves_faster(const State<2> &state, const double dt) const
  {
    // Once in two steps is often enough: what is faster than a skin in one ends
    // the run.
    if (state.step % 2 != 0)
      return false;
    using F           = LaneFunctions<native_lanes>;
    const double *of  = reinterpret_cast<const double *>(state.velocity.data());
    VectorRange range = range_of(
        VectorRange::dim * exchange.n_owned(),
        [of](const std::size_t i) { return F::load(of + i); },
        [of](const std::size_t i) { return of[i]; });
    MPI_Allreduce(MPI_IN_PLACE, range.largest.data(), int(range.largest.size()),
                  MPI_DOUBLE, MPI_MAX, exchange.communicator());
    return range.diagonal() * dt > state.get<ContactState>().foreseen;
  }

  void BlockContacts::check(State<2> &state, const double dt)
  {
    ContactState &contacts = state.get<ContactState>();
    const bool is_first    = contacts.n_searches == 0;
    contacts.handed_over.resize(node_map.table().joined.size(), 0);
    Look look;
    for (unsigned int i = 0; i < edges.boundary_nodes().size(); ++i)
    {
      const unsigned int node = edges.boundary_nodes()[i];
      look.speed.take(state.velocity[node]);
      if (!is_first)
        look.moved.take(state.nodes[node].position()
                        - contacts.search_positions[i]);
    }
    look.changed  = find_handovers(edges, joints, parameters.handover, state)
                           || search_is_due
                        ? 1.
                        : 0.;
    search_is_due = false;
    look.deepest  = deepest_ratio;
    look.collect(exchange.communicator());
    if (look.changed > 0.)
      hand_over(edges, joints, exchange.communicator(), state);
    if (look.deepest > 1.)
      refuse_depth(state, look.deepest);
    const double fastest = std::sqrt(look.speed.square);
    if (fastest * dt > search.skin().largest())
      refuse_speed(state, fastest, dt);

    // What edges may approach in a step until the next look, at twice the
    // present speed.
    const double ahead    = 2. * look.speed.difference() * dt;
    const double approach = look.moved.difference();
    double left           = contacts.skin - approach;
    if (is_first || look.changed > 0. || left < ahead
        || state.step >= contacts.renewal)
    {
      const auto start   = WallClock::now();
      const double steps = state.step - contacts.searched;
      const double rate  = approach / std::max(1., steps);
      search.renew(state, rate);
      bind(contacts);
      near.moving_edges().gather(state);
      inherit_shifts(near, contacts);
      reanchor(near, contacts);
      spent.search_seconds += seconds_since(start);
      contacts.searched = state.step;
      contacts.renewal  = search.skin().renewal(contacts, rate);
      left              = contacts.skin;
    }
    const std::uint64_t steps = search.skin().interval(contacts, left, ahead);
    contacts.next_check       = state.step + steps;
    contacts.foreseen         = std::max(left, ahead) / double(steps);
  }

  void BlockContacts::add_stiffness_bound(
      const State<2> &, const NodeRatio &,
      std::vector<NodeStiffness<2>> &stiffness) const
  {
    // A spring k between nodes a and b has no more energy than 2 k at each.
    const auto acts           = contact_laws.sets_on_blocks(joints, node_map);
    const unsigned int n_sets = contact_laws.laws().size();
    std::vector<double> stiffest(node_map.table().n_blocks(), 0.);
    for (unsigned int b = 0; b < stiffest.size(); ++b)
      for (unsigned int s = 0; s < n_sets; ++s)
        if (acts[b * n_sets + s])
          for (const double largest : stiffness_bound(contact_laws.laws()[s]))
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

  void BlockContacts::add_damping_bound(const std::vector<double> &masses,
                                        const double impedance,
                                        DampingBound &bound) const
  {
    NodeAreas area(node_map.n_local());
    for_each_boundary_edge(
        node_map, thickness,
        [&](const std::array<unsigned int, 2> &edge, const double tributary)
        {
          for (const unsigned int node : edge)
            area[node][0] += tributary;
        });
    node_map.exchange().add_to_owners(area.data());
    add_dashpots(node_map, area, contact_laws.laws(), contact_laws.dampings(),
                 masses, impedance, bound);
  }
  void BlockContacts::bind(const ContactState &contacts)
  {
    near.bind(contacts);
    const unsigned int n_nodes = near.moving_edges().positions().size();
    compact_force.assign(n_nodes, dealii::Tensor<1, 2>());
    compact_viscous.assign(n_nodes, dealii::Tensor<1, 2>());
    if (all_dashpots.act())
      all_dashpots.bind(contacts, edges);
    deepest_ratio = 0.;
    bound_search  = contacts.n_searches;
  }

  void BlockContacts::note_depth(const unsigned int pair, const double depth)
  {
    const double ratio = depth / near.weights()[pair].depth;
    if (ratio > deepest_ratio)
    {
      deepest_ratio = ratio;
      deepest_pair  = pair;
    }
  }

  bool BlockContacts::begin_contact(ContactState &contacts,
                                    const unsigned int i,
                                    const NearPairs::Geometry &g)
  {
    ContactPair &pair    = contacts.pairs[i];
    const double opening = std::min(g.opening[0], g.opening[1]);
    unsigned int set     = pair.set;
    ContactPoint inherited;
    double deepest     = 0.;
    const bool is_heir = find_parent(contacts, i, set, inherited, deepest);
    if (opening >= inherited.plastic_opening)
      return false;
    const MovingEdges &moving  = near.moving_edges();
    const auto &[lower, upper] = near.edges_of(i);
    const unsigned int deeper  = g.opening[0] <= g.opening[1] ? 0 : 1;
    const auto is_inside       = [&, &lower = lower, &upper = upper]()
    {
      return g.share[deeper] < 0.5
                 ? moving.vertex_is_inside(lower, deeper, upper)
                 : moving.vertex_is_inside(upper, 1 - deeper, lower);
    };
    const double depth = std::min(0., inherited.plastic_opening) - opening;
    if (depth >= near.weights()[i].depth)
    {
      // The edges were apart in the step before: they move too fast for a
      // contact to stop them, and the next check ends the run.
      if (pair.was_open && is_inside())
        note_depth(i, depth);
      return false;
    }
    // Edges that overlap from behind, as those of thin wedges which lie on
    // each other, were never apart, and their vertices lie outside.
    if (!pair.was_open
        && opening < deepest
                         - first_overlap
                               * std::min(moving[lower].length,
                                          moving[upper].length)
        && !is_inside())
      return false;

    if (!is_heir)
      contact_laws.with_law(set, [&](const auto &law)
                            { begin_point(law, inherited); });
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
      point.slip_offset
          = inherited.slip_offset - near.slip(point, i, g.normal[k]);
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
      const unsigned int shared = near.edges_of(i)[side];
      const auto &beside
          = near.moving_edges().links(near.edges_of(i)[1 - side]).neighbours;
      for (const unsigned int q : near.entries_of(shared))
      {
        const ContactPair &parent = near.pair_or_copy(contacts, q);
        if (q == i || !parent.active)
          continue;
        const unsigned int at    = near.edges_of(q)[0] == shared ? 1 : 0;
        const unsigned int other = near.edges_of(q)[at];
        if (other != beside[0] && other != beside[1])
          continue;
        NearPairs::Geometry g;
        if (!near.geometry(parent, q, g))
          continue;
        const double vertex = other == beside[1] ? 0. : 1.;
        const double *place = at == 0 ? g.lower : g.upper;
        const unsigned int k
            = std::abs(place[0] - vertex) <= std::abs(place[1] - vertex) ? 0
                                                                         : 1;
        deepest               = std::min(g.opening[0], g.opening[1]);
        set                   = parent.set;
        inherited             = parent.points[k];
        inherited.slip_offset = near.slip(inherited, q, g.normal[k]);
        return true;
      }
    }
    return false;
  }

  void BlockContacts::add_stored_energy(const State<2> &state,
                                        EnergyAccounts &energies) const
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
        contact_laws.with_law(
            pair.set,
            [&](const auto &law)
            {
              energy
                  += near.weights()[i].share * point.area
                     * law.stored_energy(read_point(law, point), point.opening);
            });
      }
    }
    energies.joint += energy;
  }

  template <int lanes>
  void BlockContacts::begin_contacts(ContactState &contacts)
  {
    // Before any pair is brought to the present, so that heirs go on from the
    // same past as those they follow, whatever the order of the pairs.
    near.update_copies(contacts);
    // Beside a contact that has dilated edges touch before they meet.
    mark_distant(near, !contact_laws.dilates(), contacts);
    list_pairs(contacts.marks, active_pairs, idle_pairs);
    // Only idle pairs that may overlap are looked at more closely.
    unsigned int n_idle = 0;
    for (unsigned int j = 0; j < idle_pairs.size(); j += lanes)
    {
      const unsigned int n
          = std::min<unsigned int>(lanes, idle_pairs.size() - j);
      const PairPack<lanes> pack(near, &idle_pairs[j], n);
      const unsigned int overlap = LaneFunctions<lanes>::set_lanes(
          PairFunctions<lanes>::may_overlap(pack.a, pack.b));
      for (unsigned int l = 0; l < n; ++l)
      {
        idle_pairs[n_idle] = pack.pair[l];
        n_idle += overlap >> l & 1;
        PairMark &mark = contacts.marks[pack.pair[l]];
        if (mark == PairMark::open && (~overlap >> l & 1))
        {
          mark                                  = PairMark::unseen;
          contacts.pairs[pack.pair[l]].was_open = 0;
        }
      }
    }
    new_contacts.clear();
    for (unsigned int j = 0; j < n_idle; j += lanes)
      look_at_idle<lanes>(&idle_pairs[j],
                          std::min<unsigned int>(lanes, n_idle - j), contacts);
    for (const unsigned int i : new_contacts)
    {
      contacts.pairs[i].active = 1;
      contacts.marks[i]        = mark_of_active(contacts.pairs[i]);
      active_pairs.push_back(i);
    }
  }

  template <int lanes>
  void BlockContacts::look_at_idle(const unsigned int *idle,
                                   const unsigned int n, ContactState &contacts)
  {
    const MovingEdges &moving = near.moving_edges();
    using F                   = LaneFunctions<lanes>;
    const PairPack<lanes> pack(near, idle, n);
    // Areas do not count.
    PairLanes<lanes> pairs{};
    PairGeometry<lanes> g;
    const unsigned int found = F::set_lanes(
        moving.find_geometry(pairs, pack.lower, pack.a, pack.upper, pack.b, g));
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
      NearPairs::Geometry own;
      if ((!is_open || contact_laws.dilates()) && near.geometry(pair, i, own)
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
          contact_laws.laws()[set]);
    };
    if (contact_laws.laws().size() == 1)
    {
      add(0, active_pairs);
      return;
    }
    pairs_of_set.resize(contact_laws.laws().size());
    for (std::vector<unsigned int> &list : pairs_of_set)
      list.clear();
    for (const unsigned int i : active_pairs)
      pairs_of_set[contacts.pairs[i].set].push_back(i);
    for (unsigned int set = 0; set < contact_laws.laws().size(); ++set)
      add(set, pairs_of_set[set]);
  }

  template <int lanes, typename Law>
  void BlockContacts::add_forces_under(const Law &law,
                                       const std::vector<unsigned int> &active,
                                       ContactState &contacts,
                                       const double viscous_beta,
                                       const bool damps, Losses &losses)
  {
    const MovingEdges &moving = near.moving_edges();
    using L                   = Lanes<lanes>;
    using F                   = LaneFunctions<lanes>;
    using P                   = PairFunctions<lanes>;
    using Value               = typename F::Value;
    using Bits                = typename F::Bits;

    const typename ContactPack<Law, lanes>::Laws laws_in_lanes(law);
    ContactPack<Law, lanes> pack;
    const Value none{};
    DissipationLanes<lanes> lost;
    Value lost_by_contact{};
    const unsigned int n_active = active.size();
    for (unsigned int first = 0; first < n_active; first += lanes)
    {
      const unsigned int n   = std::min<unsigned int>(lanes, n_active - first);
      const unsigned int all = (1U << n) - 1;
      const PairPack<lanes> edges_of(near, &active[first], n);
      const auto &[pair, ea, eb, a, b] = edges_of;
      ContactPair *pairs               = contacts.pairs.data();
      PairLanes<lanes> at{};
      bool is_shifted = false;
      for (const std::uint32_t i : pair)
        is_shifted |= contacts.marks[i] == PairMark::shifted;
      if (is_shifted)
      {
        L::load(reinterpret_cast<const char *>(&pairs->shift),
                sizeof(ContactPair), pair, at.shift, at.shift_start);
        unsigned int was_joint = 0;
        for (unsigned int l = 0; l < lanes; ++l)
          was_joint |= (pairs[pair[l]].was_joint != 0 ? 1U : 0U) << l;
        at.was_joint = F::mask_of(was_joint);
      }
      at.active             = none == none;
      const Bits is_general = at.was_joint == Bits{};
      Value share, depth_limit;
      L::load(reinterpret_cast<const char *>(near.weights().data()),
              sizeof(NearPairs::Weight), pair, share, depth_limit);

      pack.load(pairs, pair, 0);
      at.anchor = pack.anchor;
      PairGeometry<lanes> g;
      const unsigned int found
          = F::set_lanes(moving.find_geometry(at, ea, a, eb, b, g)) & all;
      const Bits present = F::mask_of(found);
      TractionLanes<lanes> forces, viscous;
#pragma GCC unroll 2
      for (unsigned int k = 0; k < 2; ++k)
      {
        if (found == 0)
          break;
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
          moving.relative_velocity<lanes>(ea, eb, g.lower[k], g.upper[k], rate);
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
            all_dashpots.add(
                { pair[l],
                  k,
                  F::at(g.area[k], l),
                  F::at(g.lower[k], l),
                  F::at(g.upper[k], l),
                  { F::at(normal[0], l), F::at(normal[1], l) },
                  { F::at(opening, l), F::at(slip_now, l) },
                  { F::at(stiffness[0], l), F::at(stiffness[1], l) } });
      }
      moving.add_to_ends(P::end_forces(a, b, forces), ea, eb, found,
                         compact_force.data());
      if (viscous_beta > 0.)
        moving.add_to_ends(P::end_forces(a, b, viscous), ea, eb, found,
                           compact_viscous.data());
      for (unsigned int l = 0; l < n && found != all; ++l)
        if (~found >> l & 1)
        {
          losses.contact += near.weights()[pair[l]].share
                            * contact_laws.release(pairs[pair[l]]);
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
    const bool damps          = forces.viscous && all_dashpots.act();
    if (viscous_beta > 0. || damps)
      near.moving_edges().gather_velocities(state.velocity.data());
    all_dashpots.clear();
    if (contacts.marks.empty())
      make_marks(contacts);
    spent.updates += contacts.pairs.size();
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
      all_dashpots.add_forces(contacts, compact_viscous.data());
    state.energy.friction += losses.friction;
    state.energy.fracture += losses.fracture;
    state.energy.crushing += losses.crushing;
    state.energy.contact += losses.contact;

    near.moving_edges().scatter(compact_force, forces.force);
    if (viscous_beta > 0. || damps)
      near.moving_edges().scatter(compact_viscous, forces.viscous);
  }

  void BlockContacts::refuse_depth(const State<2> &state,
                                   const double ratio) const
  {
    // The first rank that knows of it tells the others.
    const unsigned int n
        = dealii::Utilities::MPI::n_mpi_processes(exchange.communicator());
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(exchange.communicator());
    const unsigned int teller = dealii::Utilities::MPI::min(
        deepest_ratio == ratio ? rank : n, exchange.communicator());
    double told[5]{};
    if (rank == teller)
    {
      const ContactPair &pair = state.get<ContactState>().pairs[deepest_pair];
      const auto &edge = near.moving_edges()[near.edges_of(deepest_pair)[0]];
      told[0]          = edges[pair.lower].block;
      told[1]          = edges[pair.upper].block;
      told[2]          = edge.x;
      told[3]          = edge.y;
      told[4]          = ratio * near.weights()[deepest_pair].depth;
    }
    MPI_Bcast(told, 5, MPI_DOUBLE, teller, exchange.communicator());
    std::ostringstream message;
    message << "blocks " << told[0] << " and " << told[1] << " overlap by "
            << told[4] << " m near (" << told[2] << ", " << told[3]
            << ") m, at time " << state.time << " s, step " << state.step
            << ", more than 'Contact/Deepest overlap = " << parameters.deepest
            << "' of the cells there. The usual causes are contacts too soft "
               "for the load or the impact (raise 'Normal stiffness'), a time "
               "step too long (lower 'Share of critical time step'), or "
               "blocks that overlap in the mesh. The last checkpoint is kept.";
    throw RunError(message.str());
  }

  void BlockContacts::refuse_speed(const State<2> &state, const double speed,
                                   const double dt) const
  {
    unsigned int fast = NodeMap<2>::none;
    for (const unsigned int i : edges.boundary_nodes())
    {
      const dealii::Tensor<1, 2> &v = state.velocity[i];
      if (std::sqrt(v[0] * v[0] + v[1] * v[1]) >= speed)
        fast = std::min(fast, i);
    }
    dealii::Point<2> p;
    unsigned int block = 0;
    if (!first_point(node_map, fast, p, &block)) // the root was rounded
      p = point_of_block(node_map, block);       // otherwise than here
    std::ostringstream message;
    message << "block " << block << ", at rest at " << point_text(p)
            << " m, moves at " << speed << " m/s, that is " << speed * dt
            << " m a step at time " << state.time << " s, step " << state.step
            << ": so fast that it would pass through others, whose skin is "
            << search.skin().largest()
            << " m. If nothing should move like that, the run is unstable: "
               "lower 'Share of critical time step' and look at the last "
               "fields. The last checkpoint is kept.";
    throw RunError(message.str());
  }
} // namespace quoin
