// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/vector_range.h>
#include <quoin/contact_geometry/edge_lanes.h>
#include <quoin/contact_geometry/moving_edges.h>
#include <quoin/operators/archive.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    constexpr unsigned int none = ContactEdges::none;
  }

  MovingEdges::MovingEdges(const NodeMap<2> &nodes, ContactEdges &edges,
                           const ContactParameters &parameters,
                           const Thickness &thickness)
    : exchange(nodes.exchange()), edges(edges), parameters(parameters),
      thickness(thickness)
  {
  }

  void MovingEdges::bind(const AlignedArray<ContactPair> &pairs)
  {
    bind_edges(pairs);
    bind_nodes();
  }

  unsigned int MovingEdges::place_of(const unsigned int number) const
  {
    return std::lower_bound(edge_numbers.begin(), edge_numbers.end(), number)
           - edge_numbers.begin();
  }

  unsigned int MovingEdges::find_edge(const unsigned int number) const
  {
    if (number == none)
      return n_edges();
    if (edges.is_own(number))
      return index_of_own[edges.own_place(number)];
    const unsigned int place = place_of(number);
    return place < n_edges() && edge_numbers[place] == number ? place
                                                              : n_edges();
  }

  void MovingEdges::bind_edges(const AlignedArray<ContactPair> &pairs)
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
    // Own edges are taken once, which leaves little to sort.
    index_of_own.assign(edges.own().size(), none);
    const auto take = [this](const unsigned int number)
    {
      if (edges.is_own(number))
      {
        unsigned int &index = index_of_own[edges.own_place(number)];
        if (index != none)
          return;
        index = 0;
      }
      edge_numbers.push_back(number);
    };
    for (const ContactPair &pair : pairs)
    {
      take(pair.lower);
      take(pair.upper);
    }
    find(edge_numbers);
    const unsigned int n_taken = edge_numbers.size();
    for (unsigned int e = 0; e < n_taken; ++e)
    {
      const ContactEdge &edge = edges[edge_numbers[e]];
      for (const unsigned int neighbour : { edge.previous, edge.next })
        if (neighbour != none)
          take(neighbour);
    }
    find(edge_numbers);
    edges.keep(edge_numbers);
    std::fill(index_of_own.begin(), index_of_own.end(), n_edges());
    for (unsigned int e = 0; e < n_edges(); ++e)
      if (edges.is_own(edge_numbers[e]))
        index_of_own[edges.own_place(edge_numbers[e])] = e;

    // Lanes beyond the last edge have some that no pair has.
    const unsigned int n_places
        = (edge_numbers.size() + most_lanes) / most_lanes * most_lanes;
    local_edges.assign(n_places, Edge());
    edge_links.assign(n_places, Links());
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
        const unsigned int next = find_edge(k == 0 ? edge.previous : edge.next);
        edge_links[e].neighbours[k] = next < n_edges() ? next : e;
      }
    }
  }

  void MovingEdges::bind_nodes()
  {
    // Nodes of own edges first, then those of foreign ones, both ascending.
    std::vector<unsigned int> ghosts;
    compact_own.clear();
    index_of_node.resize(exchange.n_local(), none);
    for (const unsigned int e : edge_numbers)
      if (edges.is_own(e))
        for (const unsigned int i : edges.local_nodes()[edges.own_place(e)])
        {
          if (index_of_node[i] == none)
            compact_own.push_back(i);
          index_of_node[i] = 0;
        }
      else
        for (const unsigned int v : edges[e].nodes)
          ghosts.push_back(v);
    std::sort(compact_own.begin(), compact_own.end());
    for (unsigned int i = 0; i < compact_own.size(); ++i)
      index_of_node[compact_own[i]] = i;
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    if (dealii::Utilities::MPI::max(!reach || ghosts != far_nodes ? 1U : 0U,
                                    exchange.communicator())
        > 0)
      reach = std::make_unique<NodeExchange>(exchange.with_partners(ghosts));
    far_nodes = ghosts;

    for (unsigned int e = 0; e < edge_numbers.size(); ++e)
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int number = edge_numbers[e];
        if (edges.is_own(number))
          edge_links[e].nodes[k]
              = index_of_node[edges.local_nodes()[edges.own_place(number)][k]];
        else
          edge_links[e].nodes[k]
              = compact_own.size()
                + (std::lower_bound(far_nodes.begin(), far_nodes.end(),
                                    edges[number].nodes[k])
                   - far_nodes.begin());
      }
    for (const unsigned int i : compact_own)
      index_of_node[i] = none;

    ghost_nodes.resize(ghosts.size());
    ghost_velocity.resize(ghosts.size());
    const unsigned int n_nodes = compact_own.size() + ghosts.size();
    position.resize(n_nodes);
    compact_velocity.resize(n_nodes);
  }

  void MovingEdges::gather(const State<2> &state)
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

  void MovingEdges::gather_velocities(const dealii::Tensor<1, 2> *velocity)
  {
    reach->update_ghosts(velocity, ghost_velocity.data());
    dealii::Tensor<1, 2> *to = compact_velocity.data();
    for (const unsigned int i : compact_own)
      *to++ = velocity[i];
    std::copy(ghost_velocity.begin(), ghost_velocity.end(), to);
  }

  void MovingEdges::scatter(AlignedArray<dealii::Tensor<1, 2>> &from,
                            dealii::Tensor<1, 2> *to) const
  {
    for (unsigned int j = 0; j < compact_own.size(); ++j)
      to[compact_own[j]] += from[j];
    std::fill(from.begin(), from.end(), dealii::Tensor<1, 2>());
  }

  double MovingEdges::motion_since(
      const AlignedArray<dealii::Tensor<1, 2>> &from) const
  {
    using F              = LaneFunctions<native_lanes>;
    const double *now    = reinterpret_cast<const double *>(position.data());
    const double *before = reinterpret_cast<const double *>(from.data());
    return range_of(
               VectorRange::dim * position.size(),
               [&](const std::size_t i)
               { return F::load(now + i) - F::load(before + i); },
               [&](const std::size_t i) { return now[i] - before[i]; })
        .diagonal();
  }

  bool MovingEdges::vertex_is_inside(const unsigned int e, const unsigned int k,
                                     const unsigned int touched_edge) const
  {
    const Edge &touched                = local_edges[touched_edge];
    const Links &links                 = edge_links[touched_edge];
    const dealii::Tensor<1, 2> &vertex = position[edge_links[e].nodes[k]];
    for (const unsigned int beside : links.neighbours)
    {
      const Edge &next     = local_edges[beside];
      const bool is_before = beside == links.neighbours[0];
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
} // namespace quoin
