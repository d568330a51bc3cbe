// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What the contact operator does between steps: watches motions, hands over
// joints, searches pairs and prepares for them. block_contacts.cc has the
// forces.

#include <quoin/operators/archive.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/wall_clock.h>
#include <quoin/contact/contact_search.h>
#include <quoin/contact/contact_sets.h>
#include <quoin/mesh/global_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "contact_pairs.h"

namespace quoin
{
  namespace
  {
    constexpr unsigned int none = ContactEdges::none;
    constexpr double infinity   = std::numeric_limits<double>::infinity();

    /** Most steps between two looks at the motions, with a skin not below the
        first one; with a smaller one there are fewer. */
    constexpr double longest_interval = 50.;
    /** First and largest automatic skin by the median edge. */
    constexpr double first_skin = 0.02, most_skin = 0.2;
    /** Automatic skins are the largest one by powers of the square root of 2.
     */
    constexpr unsigned int n_skins = 14;
    /** By how much an automatic skin may grow from one search to the next. */
    constexpr double growth = 2.;
    /** What a search costs for each edge, by what a step costs for each pair.
     */
    constexpr double cost_of_search = 60.;
    /** Steps after which a first search is followed by another, which knows of
        the motions, and, by the number of steps that a skin is made for, those
        after which another one may be cheaper. */
    constexpr std::uint64_t first_steps = 100;
    constexpr double patience           = 4.;

    /** Those from @p largest on, descending. */
    std::array<double, n_skins> automatic_skins(const double largest)
    {
      std::array<double, n_skins> skins;
      for (unsigned int k = 0; k < n_skins; ++k)
        skins[k] = largest * std::pow(0.5, 0.5 * k);
      return skins;
    }

    /** The largest square, x, -x, y and -y among vectors on all ranks. */
    struct Spread
    {
      static constexpr double none_yet
          = -std::numeric_limits<double>::infinity();
      std::array<double, 5> largest{ { 0., none_yet, none_yet, none_yet,
                                       none_yet } };

      void take(const double x, const double y)
      {
        const std::array<double, 5> values{ { x * x + y * y, x, -x, y, -y } };
        for (unsigned int i = 0; i < values.size(); ++i)
          largest[i] = std::max(largest[i], values[i]);
      }
      /** A bound of the difference of two of them: what all share is none. */
      double difference() const
      {
        return std::min(
            2. * std::sqrt(largest[0]),
            std::hypot(largest[1] + largest[2], largest[3] + largest[4]));
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

    /** Median of the edges of all ranks. Collective. */
    double median_length(const ContactEdges &edges, const MPI_Comm communicator)
    {
      std::vector<double> lengths;
      for (const ContactEdge &edge : edges.own())
        lengths.push_back(edge.length);
      // Positive numbers ascend as their bits do, so that of the number with as
      // many below it one byte after the other is found by counting.
      unsigned int below  = edges.n_global() / 2;
      std::uint64_t found = 0;
      for (int shift = 56; shift >= 0; shift -= 8)
      {
        std::vector<unsigned int> counts(256, 0);
        for (const double length : lengths)
        {
          std::uint64_t bits;
          std::memcpy(&bits, &length, sizeof(bits));
          if (shift == 56 || bits >> (shift + 8) == found)
            ++counts[bits >> shift & 255U];
        }
        dealii::Utilities::MPI::sum(counts, communicator, counts);
        unsigned int byte = 0;
        while (below >= counts[byte])
          below -= counts[byte++];
        found = found << 8U | byte;
      }
      double median;
      std::memcpy(&median, &found, sizeof(median));
      return median;
    }

    /** Owned nodes where an edge of any rank starts. Collective. */
    std::vector<unsigned int> find_boundary_nodes(const ContactEdges &edges,
                                                  const NodeExchange &exchange)
    {
      std::vector<dealii::Tensor<1, 1>> n_edges(exchange.n_local(),
                                                dealii::Tensor<1, 1>({ 0. }));
      for (const auto &[first, last] : edges.local_nodes())
        n_edges[first][0] += 1.;
      exchange.add_to_owners(n_edges.data());
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < exchange.n_owned(); ++i)
        if (n_edges[i][0] > 0.)
          result.push_back(i);
      return result;
    }
  } // namespace

  BlockContacts::BlockContacts(const NodeMap<2> &node_map,
                               const MatchedJoints &joints,
                               const ContactModel &model)
    : node_map(node_map), joints(joints), exchange(node_map.exchange()),
      edges(node_map), copies(edges, node_map.communicator()),
      parameters(model.parameters), thickness(model.thickness),
      largest_skin(model.parameters.skin), materials(model.materials),
      material_of_group(model.material_of_group)
  {
    if (largest_skin == 0.)
      largest_skin = most_skin * median_length(edges, node_map.communicator());
    set_laws(model.sets);
    find_set_of_materials(model.sets);
    boundary_nodes = find_boundary_nodes(edges, exchange);
  }

  void BlockContacts::set_laws(const std::vector<JointSetParameters> &sets)
  {
    laws.clear();
    dampings.clear();
    dilates = false;
    for (const JointSetParameters &set : sets)
    {
      laws.push_back(set.law);
      dampings.push_back(set.damping);
      dilates = dilates || can_dilate(set.law);
    }
  }

  void BlockContacts::find_set_of_materials(
      const std::vector<JointSetParameters> &sets)
  {
    set_of_materials     = sets_of_new_contacts(sets, materials);
    const unsigned int n = materials.size();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        if (set_of_materials[i * n + j] == no_contact_set)
          throw InputError(
              "section 'Joints': with 'Contact/Displacements = large' "
              "blocks of '"
              + materials[i] + "' and '" + materials[j]
              + "' may touch anew, but no set says how. Give one 'New "
                "contacts between = "
              + materials[i] + ":" + materials[j] + "' or 'all'.");
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
    if (state.step >= contacts.next_check)
      check(state, step.dt);
    gather(state);
  }

  void BlockContacts::check(State<2> &state, const double dt)
  {
    ContactState &contacts = state.get<ContactState>();
    const bool is_first    = contacts.n_searches == 0;
    contacts.handed_over.resize(node_map.table().joined.size(), 0);
    Look look;
    for (unsigned int i = 0; i < boundary_nodes.size() && !is_first; ++i)
    {
      const NodeRecord<2> &node        = state.nodes[boundary_nodes[i]];
      const dealii::Tensor<1, 2> &from = contacts.search_positions[i];
      const dealii::Tensor<1, 2> &v    = state.velocity[boundary_nodes[i]];
      look.moved.take(node.X[0] + node.u[0] - from[0],
                      node.X[1] + node.u[1] - from[1]);
      look.speed.take(v[0], v[1]);
    }
    look.changed  = find_handovers(state) || search_is_due ? 1. : 0.;
    search_is_due = false;
    look.deepest  = deepest_ratio;
    look.collect(exchange.communicator());
    if (look.changed > 0.)
      hand_over(state);
    if (look.deepest > 1.)
      refuse_depth(state, look.deepest);
    const double fastest = std::sqrt(look.speed.largest[0]);
    if (fastest * dt > largest_skin)
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
      search(state, rate);
      seconds += seconds_since(start);
      contacts.searched = state.step;
      contacts.renewal  = renewal(contacts, rate);
      left              = contacts.skin;
    }
    const double longest
        = std::clamp(std::floor(longest_interval * most_skin / first_skin
                                * contacts.skin / largest_skin),
                     1., longest_interval);
    const double interval
        = ahead > 0. ? std::clamp(std::floor(left / ahead), 1., longest)
                     : longest;
    contacts.next_check = state.step + static_cast<std::uint64_t>(interval);
  }

  std::uint64_t BlockContacts::renewal(const ContactState &contacts,
                                       const double rate) const
  {
    const double steps = patience * contacts.skin / rate;
    if (parameters.skin > 0.)
      return -1;
    if (contacts.n_searches == 1)
      return contacts.searched + first_steps;
    return steps < 1e9 ? contacts.searched + static_cast<std::uint64_t>(steps)
                       : -1;
  }

  double BlockContacts::search_distance(const ContactState &contacts) const
  {
    if (parameters.skin > 0.)
      return parameters.skin;
    return contacts.n_searches == 0
               ? first_skin / most_skin * largest_skin
               : std::min(largest_skin, growth * contacts.skin);
  }

  double BlockContacts::cheapest_skin(std::vector<unsigned int> sides,
                                      const double rate,
                                      const ContactState &contacts) const
  {
    dealii::Utilities::MPI::sum(sides, exchange.communicator(), sides);
    double best = search_distance(contacts), least = infinity;
    const auto skins = automatic_skins(largest_skin);
    for (unsigned int k = 0; k < n_skins; ++k)
    {
      const double skin = skins[k];
      if (skin > 1.001 * search_distance(contacts))
        continue;
      const double cost
          = 0.5 * sides[k] + cost_of_search * edges.n_global() * rate / skin;
      if (cost < least)
      {
        best  = skin;
        least = cost;
      }
    }
    return best;
  }

  std::vector<std::array<unsigned int, 2>>
  BlockContacts::find_pairs(const std::vector<EdgeEnds> &ends,
                            const double apart, const double rate,
                            ContactState &contacts) const
  {
    std::vector<std::array<unsigned int, 2>> found, result;
    std::vector<double> needed;
    std::vector<unsigned int> sides(n_skins, 0);
    const auto skins = automatic_skins(largest_skin);
    for (const auto &[i, j] :
         near_edges(edges, ends, search_distance(contacts) + apart))
    {
      if (is_matched(contacts, ends[i].edge, ends[j].edge))
        continue;
      found.push_back({ { i, j } });
      needed.push_back(motion_to_touch(ends[i], ends[j], apart));
      unsigned int n = 0;
      while (n < n_skins && needed.back() <= skins[n])
        ++n;
      if (n > 0)
        sides[n - 1] += ends[i].is_own + ends[j].is_own;
    }
    for (unsigned int k = n_skins - 1; k > 0; --k)
      sides[k - 1] += sides[k];
    if (parameters.skin > 0. || contacts.n_searches == 0)
      contacts.skin = search_distance(contacts);
    else
      contacts.skin = cheapest_skin(sides, rate, contacts);
    for (unsigned int p = 0; p < found.size(); ++p)
      if (needed[p] <= contacts.skin)
        result.push_back(found[p]);
    return result;
  }

  bool BlockContacts::find_handovers(State<2> &state) const
  {
    ContactState &contacts      = state.get<ContactState>();
    const JointHistory &history = state.get<JointHistory>();
    bool found                  = false;
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointEdges &joint = edges.joint_edges(joints.segments()[i].face);
      if (history.handed_over[i]
          || (history.state[2 * i] == JointState::intact
              && history.state[2 * i + 1] == JointState::intact)
          || edges.has_tip(joint.interface))
        continue;
      const double limit = parameters.handover * edges[joint.edges[0]].length;
      const auto gaps    = joint_gaps(joints.segments()[i], state.nodes.data());
      for (const auto &[opening, slip] : gaps)
        if (opening > limit || std::abs(slip) > limit)
        {
          contacts.handed_over[joint.interface] = 1;
          found                                 = true;
        }
    }
    return found;
  }

  void BlockContacts::hand_over(State<2> &state) const
  {
    ContactState &contacts = state.get<ContactState>();
    JointHistory &history  = state.get<JointHistory>();
    // Joints between two blocks go together, whatever their ranks.
    MPI_Allreduce(MPI_IN_PLACE, contacts.handed_over.data(),
                  contacts.handed_over.size(), MPI_UINT8_T, MPI_MAX,
                  exchange.communicator());
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointEdges &joint = edges.joint_edges(joints.segments()[i].face);
      if (history.handed_over[i] || !contacts.handed_over[joint.interface])
        continue;
      const auto &segment = joints.segments()[i];
      const auto gaps = joint_gaps(joints.segments()[i], state.nodes.data());
      ContactPair pair;
      pair.lower       = joint.edges[0];
      pair.upper       = joint.edges[1];
      pair.set         = segment.set;
      pair.active      = 1;
      pair.was_joint   = 1;
      pair.shift       = 0.5 * (gaps[0][1] + gaps[1][1]);
      pair.shift_start = pair.shift;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int p  = 2 * i + k;
        ContactPoint &point   = pair.points[k];
        point.normal_traction = history.normal_traction[p];
        point.shear_traction  = history.shear_traction[p];
        point.plastic_slip    = history.plastic_slip[p];
        point.plastic_opening = history.plastic_opening[p];
        for (unsigned int j = 0; j < JointHistory::most_internal; ++j)
          if (!history.internal[j].empty())
            point.internal[j] = history.internal[j][p];
        point.state   = history.state[p];
        point.area    = segment.area[k];
        point.opening = gaps[k][0];
        // The vertices that coincided; the upper edge runs backwards.
        point.anchor_lower         = k;
        point.anchor_upper         = 1. - k;
        history.normal_traction[p] = 0.;
        history.shear_traction[p]  = 0.;
        history.state[p]           = JointState::open;
      }
      history.handed_over[i] = 1;
      contacts.pairs.push_back(pair);
    }
  }

  bool BlockContacts::is_matched(const ContactState &contacts,
                                 const unsigned int a,
                                 const unsigned int b) const
  {
    std::array<unsigned int, 2> blocks = { edges[a].block, edges[b].block };
    std::sort(blocks.begin(), blocks.end());
    for (const unsigned int i : { edges[a].interface, edges[b].interface })
      if (i != none && node_map.table().joined[i] == blocks
          && !contacts.handed_over[i])
        return true;
    return false;
  }

  ContactPair BlockContacts::new_pair(const EdgeEnds &a,
                                      const EdgeEnds &b) const
  {
    // The lower side is the one whose normal points up, or right if upright,
    // as in the mesh.
    const auto normal = [](const EdgeEnds &e, double *n)
    {
      const double dx = e.x[1] - e.x[0], dy = e.y[1] - e.y[0];
      const double length = std::sqrt(dx * dx + dy * dy);
      n[0]                = dy / length;
      n[1]                = -dx / length;
    };
    double na[2], nb[2];
    normal(a, na);
    normal(b, nb);
    const double x = na[0] - nb[0], y = na[1] - nb[1];
    const bool a_is_lower = std::abs(y) > 1e-6 * std::abs(x) ? y > 0. : x > 0.;
    const unsigned int n  = materials.size();
    ContactPair pair;
    pair.lower = a_is_lower ? a.edge : b.edge;
    pair.upper = a_is_lower ? b.edge : a.edge;
    pair.set   = set_of_materials[material_of_group[edges[a.edge].group] * n
                                + material_of_group[edges[b.edge].group]];
    return pair;
  }

  void BlockContacts::search(State<2> &state, const double rate)
  {
    ContactState &contacts = state.get<ContactState>();
    AlignedArray<std::uint8_t> left_out(node_map.table().n_blocks());
    for (unsigned int b = 0; b < left_out.size(); ++b)
      left_out[b] = state.is_absent(b);
    // Beside a contact that has dilated, crushed or overlaps edges touch as far
    // apart as those of the contact.
    double apart = 0.;
    for (const ContactPair &pair : contacts.pairs)
      for (const ContactPoint &point : pair.points)
        if (point.normal_traction != 0. && std::isfinite(point.opening))
          apart = std::max(apart, std::abs(point.opening));
    MPI_Allreduce(MPI_IN_PLACE, &apart, 1, MPI_DOUBLE, MPI_MAX,
                  exchange.communicator());
    const auto ends
        = edges_within_reach(node_map, edges, state.nodes.data(), left_out,
                             search_distance(contacts) + apart);
    const auto near = find_pairs(ends, apart, rate, contacts);

    const auto comes_first = [](const ContactPair &a, const ContactPair &b)
    { return a.edges() < b.edges(); };
    if (!std::is_sorted(contacts.pairs.begin(), contacts.pairs.end(),
                        comes_first)) // joints that have become contacts
      std::sort(contacts.pairs.begin(), contacts.pairs.end(), comes_first);
    AlignedArray<ContactPair> old;
    old.swap(contacts.pairs);
    contacts.pairs.reserve(near.size());
    auto next = old.begin();
    // Edges within the other block may be far from its edges.
    const auto keep_or_drop = [&](ContactPair &pair)
    {
      if (!pair.active)
        return;
      if (std::min(pair.points[0].normal_traction,
                   pair.points[1].normal_traction)
              < 0.
          && !left_out[edges[pair.lower].block]
          && !left_out[edges[pair.upper].block])
        contacts.pairs.push_back(pair);
      else
        state.energy.contact += share(pair) * release(pair);
    };
    for (const auto &[i, j] : near)
    {
      const unsigned int a = ends[i].edge, b = ends[j].edge;
      const std::array<unsigned int, 2> found = { a, b };
      for (; next != old.end() && next->edges() < found; ++next)
        keep_or_drop(*next);
      const bool is_old = next != old.end() && next->edges() == found;
      contacts.pairs.push_back(
          is_old && next->active ? *next : new_pair(ends[i], ends[j]));
      if (is_old)
      {
        ContactPair &pair = contacts.pairs.back();
        pair.was_open     = next->was_open;
        for (unsigned int k = 0; k < 2 && pair.lower == next->lower; ++k)
          pair.points[k].opening = next->points[k].opening;
        ++next;
      }
    }
    for (; next != old.end(); ++next)
      keep_or_drop(*next);

    contacts.search_positions.clear();
    for (const unsigned int i : boundary_nodes)
    {
      const NodeRecord<2> &node = state.nodes[i];
      contacts.search_positions.push_back(node.position());
    }
    ++contacts.n_searches;
    contacts.marks.clear();
    bind(contacts);
    gather(state);
    inherit_shifts(contacts);
    reanchor(contacts);
  }

  void BlockContacts::inherit_shifts(ContactState &contacts) const
  {
    // Of each edge, those of its pairs whose overlap still allows for the slip
    // of the matched joint that they were.
    const auto has_shift_left = [&](const unsigned int i)
    {
      const ContactPair &pair = pair_or_copy(contacts, i);
      if (!pair.active || pair.shift == 0.)
        return false;
      Geometry g;
      return geometry(pair, i, g) && shift_left(pair, i, g) != 0.;
    };
    std::vector<unsigned int> parents, begin{ 0 };
    for (unsigned int e = 0; e + 1 < edge_pairs_begin.size(); ++e)
    {
      for (unsigned int j = edge_pairs_begin[e]; j < edge_pairs_begin[e + 1];
           ++j)
        if (has_shift_left(edge_pairs[j]))
          parents.push_back(edge_pairs[j]);
      begin.push_back(parents.size());
    }
    if (parents.empty())
      return;
    // A new pair beside one of them allows for it too, or their lengths would
    // not add up.
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
    {
      ContactPair &pair = contacts.pairs[i];
      if (pair.active || pair.shift != 0.)
        continue;
      for (unsigned int side = 0; side < 2 && pair.shift == 0.; ++side)
      {
        const unsigned int shared = pair_edges[i][side];
        const auto &beside = edge_links[pair_edges[i][1 - side]].neighbours;
        for (unsigned int j = begin[shared]; j < begin[shared + 1]; ++j)
        {
          const unsigned int q      = parents[j];
          const ContactPair &parent = pair_or_copy(contacts, q);
          const unsigned int other
              = pair_edges[q][pair_edges[q][0] == shared ? 1 : 0];
          if (other == beside[0] || other == beside[1])
          {
            pair.shift       = parent.shift;
            pair.shift_start = parent.shift_start;
          }
        }
      }
    }
  }

  void BlockContacts::reanchor(ContactState &contacts) const
  {
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
    {
      ContactPair &pair = contacts.pairs[i];
      Geometry g;
      if (!pair.active || pair.shift != 0. || !geometry(pair, i, g))
        continue;
      for (unsigned int k = 0; k < 2; ++k)
      {
        ContactPoint &point = pair.points[k];
        const double now    = slip(point, i, g.normal[k]);
        point.anchor_lower  = g.lower[k];
        point.anchor_upper  = g.upper[k];
        point.slip_offset += now - slip(point, i, g.normal[k]);
      }
    }
  }

  float BlockContacts::share(const ContactPair &pair) const
  {
    return 0.5f * (edges.is_own(pair.lower) + edges.is_own(pair.upper));
  }

  void BlockContacts::bind(const ContactState &contacts)
  {
    bind_edges(contacts);
    bind_nodes();
    copies.bind(contacts.pairs);
    bind_pairs(contacts);
    deepest_ratio = 0.;
    bound_search  = contacts.n_searches;
  }

  unsigned int BlockContacts::local_edge(const unsigned int edge) const
  {
    return std::lower_bound(edge_numbers.begin(), edge_numbers.end(), edge)
           - edge_numbers.begin();
  }

  void BlockContacts::bind_edges(const ContactState &contacts)
  {
    // What a resumed run or one of these pairs needs and the last search did
    // not meet comes from its rank: first the edges, then their neighbours.
    const auto find = [this](std::vector<unsigned int> &numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
      edges.fetch(numbers);
    };
    edge_numbers.clear();
    for (const ContactPair &pair : contacts.pairs)
      edge_numbers.insert(edge_numbers.end(), { pair.lower, pair.upper });
    find(edge_numbers);
    const unsigned int n_edges = edge_numbers.size();
    for (unsigned int e = 0; e < n_edges; ++e)
    {
      const ContactEdge &edge = edges[edge_numbers[e]];
      for (const unsigned int neighbour : { edge.previous, edge.next })
        if (neighbour != none)
          edge_numbers.push_back(neighbour);
    }
    find(edge_numbers);
    edges.keep(edge_numbers);

    // Lanes beyond the last edge have some that no pair has.
    const unsigned int n_places
        = (edge_numbers.size() + most_lanes) / most_lanes * most_lanes;
    local_edges.assign(n_places, Edge());
    edge_links.assign(n_places, EdgeLinks());
    edge_thickness.assign(n_places, 1.);
    reference_lengths.assign(n_places, 1.);
    for (unsigned int e = 0; e < edge_numbers.size(); ++e)
    {
      const ContactEdge &edge = edges[edge_numbers[e]];
      edge_thickness[e]       = thickness[edge.group];
      reference_lengths[e]    = edge.length;
      for (unsigned int k = 0; k < 2; ++k)
      {
        edge_links[e].corner[k] = edge.corner[k];
        // The neighbours of mere neighbours are not needed.
        const unsigned int next = k == 0 ? edge.previous : edge.next;
        edge_links[e].neighbours[k]
            = next != none
                      && std::binary_search(edge_numbers.begin(),
                                            edge_numbers.end(), next)
                  ? local_edge(next)
                  : e;
      }
    }
  }

  void BlockContacts::bind_nodes()
  {
    // Nodes of own edges first, then those of foreign ones, both ascending.
    std::vector<unsigned int> ghosts;
    compact_own.clear();
    for (const unsigned int e : edge_numbers)
      if (edges.is_own(e))
        for (const unsigned int i : edges.local_nodes()[edges.own_place(e)])
          compact_own.push_back(i);
      else
        for (const unsigned int v : edges[e].nodes)
          ghosts.push_back(v);
    for (auto *list : { &compact_own, &ghosts })
    {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    if (dealii::Utilities::MPI::max(!reach || ghosts != far_nodes ? 1U : 0U,
                                    exchange.communicator())
        > 0)
      reach = std::make_unique<NodeExchange>(exchange.with_partners(ghosts));
    far_nodes = ghosts;

    const auto place = [](const std::vector<unsigned int> &list,
                          const unsigned int node) -> unsigned int
    { return std::lower_bound(list.begin(), list.end(), node) - list.begin(); };
    for (unsigned int e = 0; e < edge_numbers.size(); ++e)
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int number = edge_numbers[e];
        edge_links[e].nodes[k]
            = edges.is_own(number)
                  ? place(compact_own,
                          edges.local_nodes()[edges.own_place(number)][k])
                  : compact_own.size()
                        + place(far_nodes, edges[number].nodes[k]);
      }

    ghost_nodes.resize(ghosts.size());
    ghost_velocity.resize(ghosts.size());
    const unsigned int n_nodes = compact_own.size() + ghosts.size();
    position.resize(n_nodes);
    compact_velocity.resize(n_nodes);
    compact_force.assign(n_nodes, dealii::Tensor<1, 2>());
    compact_viscous.assign(n_nodes, dealii::Tensor<1, 2>());
  }

  void BlockContacts::bind_pairs(const ContactState &contacts)
  {
    const unsigned int n_pairs = contacts.pairs.size();
    pair_edges.clear();
    pair_weights.clear();
    edge_pairs_begin.assign(edge_numbers.size() + 1, 0);
    const auto add_edges = [this](const ContactPair &pair)
    {
      pair_edges.push_back(
          { { local_edge(pair.lower), local_edge(pair.upper) } });
      for (const unsigned int e : pair_edges.back())
        ++edge_pairs_begin[e + 1];
    };
    for (const ContactPair &pair : contacts.pairs)
    {
      add_edges(pair);
      pair_weights.push_back(
          { share(pair), parameters.deepest
                             * std::min(edges[pair.lower].height,
                                        edges[pair.upper].height) });
    }
    for (const ContactPair &pair : copies.pairs())
      add_edges(pair);
    for (unsigned int e = 0; e < edge_numbers.size(); ++e)
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
    pair_edges.resize(pair_edges.size() + most_lanes, { { 0, 0 } });
    if (has_dashpots())
      bind_dashpots(contacts);
  }

  void BlockContacts::note_depth(const unsigned int pair, const double depth)
  {
    const double ratio = depth / pair_weights[pair].depth;
    if (ratio > deepest_ratio)
    {
      deepest_ratio = ratio;
      deepest_pair  = pair;
    }
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
      const Edge &edge        = local_edges[pair_edges[deepest_pair][0]];
      told[0]                 = edges[pair.lower].block;
      told[1]                 = edges[pair.upper].block;
      told[2]                 = edge.x;
      told[3]                 = edge.y;
      told[4]                 = ratio * pair_weights[deepest_pair].depth;
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
    for (const unsigned int i : boundary_nodes)
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
    message << "block " << block << ", at rest at (" << p[0] << ", " << p[1]
            << ") m, moves at " << speed << " m/s, that is " << speed * dt
            << " m a step at time " << state.time << " s, step " << state.step
            << ": so fast that it would pass through others, whose skin is "
            << largest_skin
            << " m. If nothing should move like that, the run is unstable: "
               "lower 'Share of critical time step' and look at the last "
               "fields. The last checkpoint is kept.";
    throw RunError(message.str());
  }
} // namespace quoin
