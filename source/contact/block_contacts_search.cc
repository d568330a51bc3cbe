// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What the contact operator does between steps: watches motions, hands over
// joints, searches pairs and prepares for them. block_contacts.cc has the
// forces.

#include <quoin/operators/archive.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/wall_clock.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/contact/contact_search.h>
#include <quoin/contact/contact_sets.h>
#include <quoin/contact/joint_handover.h>
#include <quoin/mesh/global_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "pair_lanes.h"

namespace quoin
{
  namespace
  {
    constexpr unsigned int none = ContactEdges::none;

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
  } // namespace

  BlockContacts::BlockContacts(const NodeMap<2> &node_map,
                               const MatchedJoints &joints,
                               const ContactModel &model)
    : node_map(node_map), joints(joints), exchange(node_map.exchange()),
      edges(node_map), parameters(model.parameters), thickness(model.thickness),
      near(node_map, edges, parameters, thickness),
      skin(parameters.skin, edges, node_map.communicator()),
      materials(model.materials), n_lanes(model.n_lanes)
  {
    set_properties(model.sets, model.material_of_group);
    find_set_of_materials(model.sets);
  }

  void
  BlockContacts::set_properties(const std::vector<JointSetParameters> &sets,
                                const std::vector<unsigned int> &of_group)
  {
    material_of_group = of_group;
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
    near.moving_edges().gather(state);
  }

  void BlockContacts::check(State<2> &state, const double dt)
  {
    ContactState &contacts = state.get<ContactState>();
    const bool is_first    = contacts.n_searches == 0;
    contacts.handed_over.resize(node_map.table().joined.size(), 0);
    Look look;
    for (unsigned int i = 0; i < edges.boundary_nodes().size() && !is_first;
         ++i)
    {
      const NodeRecord<2> &node        = state.nodes[edges.boundary_nodes()[i]];
      const dealii::Tensor<1, 2> &from = contacts.search_positions[i];
      const dealii::Tensor<1, 2> &v = state.velocity[edges.boundary_nodes()[i]];
      look.moved.take(node.X[0] + node.u[0] - from[0],
                      node.X[1] + node.u[1] - from[1]);
      look.speed.take(v[0], v[1]);
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
    const double fastest = std::sqrt(look.speed.largest[0]);
    if (fastest * dt > skin.largest())
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
      spent.search_seconds += seconds_since(start);
      contacts.searched = state.step;
      contacts.renewal  = skin.renewal(contacts, rate);
      left              = contacts.skin;
    }
    contacts.next_check = state.step + skin.interval(contacts, left, ahead);
  }

  std::vector<std::array<unsigned int, 2>>
  BlockContacts::find_pairs(const std::vector<EdgeEnds> &ends,
                            const double apart, const double rate,
                            ContactState &contacts) const
  {
    std::vector<std::array<unsigned int, 2>> found, result;
    std::vector<double> needed;
    std::vector<unsigned int> own_edges;
    for (const auto &[i, j] :
         near_edges(edges, ends, skin.search_distance(contacts) + apart))
    {
      if (is_matched(contacts, ends[i].edge, ends[j].edge))
        continue;
      found.push_back({ { i, j } });
      needed.push_back(motion_to_touch(ends[i], ends[j], apart));
      own_edges.push_back(ends[i].is_own + ends[j].is_own);
    }
    skin.choose(needed, own_edges, rate, contacts);
    for (unsigned int p = 0; p < found.size(); ++p)
      if (needed[p] <= contacts.skin)
        result.push_back(found[p]);
    return result;
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
                             skin.search_distance(contacts) + apart);
    const auto found = find_pairs(ends, apart, rate, contacts);

    const auto comes_first = [](const ContactPair &a, const ContactPair &b)
    { return a.edges() < b.edges(); };
    if (!std::is_sorted(contacts.pairs.begin(), contacts.pairs.end(),
                        comes_first)) // joints that have become contacts
      std::sort(contacts.pairs.begin(), contacts.pairs.end(), comes_first);
    AlignedArray<ContactPair> old;
    old.swap(contacts.pairs);
    contacts.pairs.reserve(found.size());
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
        state.energy.contact += near.share(pair) * release(pair);
    };
    for (const auto &[i, j] : found)
    {
      const unsigned int a = ends[i].edge, b = ends[j].edge;
      const std::array<unsigned int, 2> these = { a, b };
      for (; next != old.end() && next->edges() < these; ++next)
        keep_or_drop(*next);
      const bool is_old = next != old.end() && next->edges() == these;
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
    for (const unsigned int i : edges.boundary_nodes())
    {
      const NodeRecord<2> &node = state.nodes[i];
      contacts.search_positions.push_back(node.position());
    }
    ++contacts.n_searches;
    contacts.marks.clear();
    bind(contacts);
    near.moving_edges().gather(state);
    inherit_shifts(contacts);
    reanchor(contacts);
  }

  void BlockContacts::inherit_shifts(ContactState &contacts) const
  {
    // Of each edge, those of its pairs whose overlap still allows for the slip
    // of the matched joint that they were.
    const auto has_shift_left = [&](const unsigned int i)
    {
      const ContactPair &pair = near.pair_or_copy(contacts, i);
      if (!pair.active || pair.shift == 0.)
        return false;
      NearPairs::Geometry g;
      return near.geometry(pair, i, g) && near.shift_left(pair, i, g) != 0.;
    };
    std::vector<unsigned int> parents, begin{ 0 };
    for (unsigned int e = 0; e < near.moving_edges().n_edges(); ++e)
    {
      for (const unsigned int q : near.entries_of(e))
        if (has_shift_left(q))
          parents.push_back(q);
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
        const unsigned int shared = near.edges_of(i)[side];
        const auto &beside
            = near.moving_edges().links(near.edges_of(i)[1 - side]).neighbours;
        for (unsigned int j = begin[shared]; j < begin[shared + 1]; ++j)
        {
          const unsigned int q      = parents[j];
          const ContactPair &parent = near.pair_or_copy(contacts, q);
          const unsigned int other
              = near.edges_of(q)[near.edges_of(q)[0] == shared ? 1 : 0];
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
      NearPairs::Geometry g;
      if (!pair.active || pair.shift != 0. || !near.geometry(pair, i, g))
        continue;
      for (unsigned int k = 0; k < 2; ++k)
      {
        ContactPoint &point = pair.points[k];
        const double now    = near.slip(point, i, g.normal[k]);
        point.anchor_lower  = g.lower[k];
        point.anchor_upper  = g.upper[k];
        point.slip_offset += now - near.slip(point, i, g.normal[k]);
      }
    }
  }

  void BlockContacts::bind(const ContactState &contacts)
  {
    near.bind(contacts);
    const unsigned int n_nodes = near.moving_edges().n_nodes();
    compact_force.assign(n_nodes, dealii::Tensor<1, 2>());
    compact_viscous.assign(n_nodes, dealii::Tensor<1, 2>());
    if (has_dashpots())
      bind_dashpots(contacts);
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
    message << "block " << block << ", at rest at (" << p[0] << ", " << p[1]
            << ") m, moves at " << speed << " m/s, that is " << speed * dt
            << " m a step at time " << state.time << " s, step " << state.step
            << ": so fast that it would pass through others, whose skin is "
            << skin.largest()
            << " m. If nothing should move like that, the run is unstable: "
               "lower 'Share of critical time step' and look at the last "
               "fields. The last checkpoint is kept.";
    throw RunError(message.str());
  }
} // namespace quoin
