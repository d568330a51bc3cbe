// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/pair_search.h>
#include <quoin/contact_geometry/contact_search.h>
#include <quoin/contact_geometry/pair_lanes.h>
#include <quoin/operators/archive.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  PairSearch::PairSearch(const NodeMap<2> &node_map, ContactEdges &edges,
                         const NearPairs &near, const ContactLaws &laws,
                         const double largest_skin)
    : node_map(node_map), edges(edges), near(near), laws(laws),
      own_skin(largest_skin, edges, node_map.communicator())
  {
  }

  std::vector<std::array<unsigned int, 2>>
  PairSearch::find_pairs(const std::vector<EdgeEnds> &ends, const double apart,
                         const double rate, ContactState &contacts) const
  {
    std::vector<std::array<unsigned int, 2>> found, result;
    std::vector<double> needed;
    std::vector<unsigned int> own_edges;
    const std::vector<NearEdges> near_ones
        = near_edges(edges, ends, own_skin.search_distance(contacts) + apart);
    found.reserve(near_ones.size());
    needed.reserve(near_ones.size());
    own_edges.reserve(near_ones.size());
    result.reserve(near_ones.size());
    for (const NearEdges &pair : near_ones)
    {
      const auto &[i, j] = pair.places;
      if (is_matched(contacts, ends[i].edge, ends[j].edge))
        continue;
      found.push_back(pair.places);
      needed.push_back(pair.motion_to_touch(apart));
      own_edges.push_back(ends[i].is_own + ends[j].is_own);
    }
    own_skin.choose(needed, own_edges, rate, contacts);
    for (unsigned int p = 0; p < found.size(); ++p)
      if (needed[p] <= contacts.skin)
        result.push_back(found[p]);
    return result;
  }

  bool PairSearch::is_matched(const ContactState &contacts,
                              const unsigned int a, const unsigned int b) const
  {
    if (edges[a].interface == ContactEdges::none
        && edges[b].interface == ContactEdges::none)
      return false;
    std::array<unsigned int, 2> blocks = { edges[a].block, edges[b].block };
    std::sort(blocks.begin(), blocks.end());
    for (const unsigned int i : { edges[a].interface, edges[b].interface })
      if (i != ContactEdges::none && node_map.table().joined[i] == blocks
          && !contacts.handed_over[i])
        return true;
    return false;
  }

  ContactPair PairSearch::new_pair(const EdgeEnds &a, const EdgeEnds &b) const
  {
    // The lower side is the one whose normal points up, or right if vertical,
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
    ContactPair pair;
    pair.lower = a_is_lower ? a.edge : b.edge;
    pair.upper = a_is_lower ? b.edge : a.edge;
    pair.set   = laws.set_between(edges[a.edge].group, edges[b.edge].group);
    return pair;
  }

  void PairSearch::renew(State<2> &state, const double rate)
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
                  node_map.communicator());
    const auto ends
        = edges_within_reach(node_map, edges, state.nodes.data(), left_out,
                             own_skin.search_distance(contacts) + apart);
    const auto found = find_pairs(ends, apart, rate, contacts);

    const auto comes_first = [](const ContactPair &a, const ContactPair &b)
    { return a.edges() < b.edges(); };
    if (!std::is_sorted(contacts.pairs.begin(), contacts.pairs.end(),
                        comes_first)) // joints that have become contacts
      std::sort(contacts.pairs.begin(), contacts.pairs.end(), comes_first);
    // Both arrays keep their memory from search to search.
    AlignedArray<ContactPair> &old = pairs_before;
    old.swap(contacts.pairs);
    contacts.pairs.clear();
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
        state.energy.contact += near.share(pair) * laws.release(pair);
    };
    for (const auto &[i, j] : found)
    {
      const unsigned int a = ends[i].edge, b = ends[j].edge;
      const std::array<unsigned int, 2> these = { a, b };
      for (; next != old.end() && next->edges() < these; ++next)
        keep_or_drop(*next);
      const bool is_old = next != old.end() && next->edges() == these;
      if (is_old && next->active)
        contacts.pairs.push_back(*next++);
      else
      {
        contacts.pairs.push_back(new_pair(ends[i], ends[j]));
        if (!is_old)
          continue;
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
  }

  void inherit_shifts(const NearPairs &near, ContactState &contacts)
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

  void reanchor(const NearPairs &near, ContactState &contacts)
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
} // namespace quoin
