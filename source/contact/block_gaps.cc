// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/block_gaps.h>
#include <quoin/contact_geometry/contact_search.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace quoin
{
  namespace
  {
    /** Approximate set of pairs of edges to be examined. */
    constexpr double most_near_pairs = 1e7;
    /** Distance of blocks that touch, by the reach. */
    constexpr double touching = 1e-5;

    /** The reach with which the edges have no more pairs than that. */
    double affordable(const ContactEdges &edges, const MPI_Comm communicator,
                      const double reach)
    {
      double length = 0.;
      for (const ContactEdge &edge : edges.own())
        length += edge.length;
      length         = dealii::Utilities::MPI::sum(length, communicator);
      const double n = edges.n_global();
      return std::min(reach, length / n * most_near_pairs / n);
    }
  } // namespace

  std::vector<double> block_gaps(const NodeMap<2> &nodes, const State<2> &state,
                                 const double reach)
  {
    using BlockPair             = std::pair<unsigned int, unsigned int>;
    const MPI_Comm communicator = nodes.communicator();
    const unsigned int n_blocks = nodes.table().n_blocks();
    AlignedArray<std::uint8_t> left_out(n_blocks);
    for (unsigned int b = 0; b < n_blocks; ++b)
      left_out[b] = state.is_absent(b);

    ContactEdges edges(nodes);
    const double within = affordable(edges, communicator, reach);
    const auto ends     = edges_within_reach(nodes, edges, state.nodes.data(),
                                             left_out, within);
    std::map<BlockPair, double> nearest;
    for (const NearEdges &pair : near_edges(edges, ends, within))
    {
      const auto &[i, j] = pair.places;
      const BlockPair blocks
          = std::minmax(edges[ends[i].edge].block, edges[ends[j].edge].block);
      if (blocks.first == blocks.second)
        continue;
      double &least = nearest.emplace(blocks, within).first->second;
      least         = std::min(least, pair.motion_to_touch(0.));
    }
    for (const auto &joined : nodes.table().joined)
      nearest[{ joined[0], joined[1] }] = 0.;

    std::map<BlockPair, double> of_all;
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(communicator, nearest))
      for (const auto &[blocks, least] : part)
      {
        double &all = of_all.emplace(blocks, least).first->second;
        all         = std::min(all, least);
      }
    constexpr double none = std::numeric_limits<double>::infinity();
    std::vector<double> gap(n_blocks, none);
    for (const auto &[blocks, least] : of_all)
      if (least > touching * reach)
        for (const unsigned int b : { blocks.first, blocks.second })
          gap[b] = std::min(gap[b], least);
    gap.erase(std::remove(gap.begin(), gap.end(), none), gap.end());
    std::sort(gap.begin(), gap.end());
    return gap;
  }
} // namespace quoin
