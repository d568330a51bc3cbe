// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_edge_lanes_h
#define quoin_contact_geometry_edge_lanes_h

#include <quoin/contact_geometry/near_pairs.h>

#include <quoin/contact_geometry/pair_lanes.h>

// Moving edges and pairs of them for PairFunctions.

namespace quoin
{
  template <int lanes>
  QUOIN_INLINE void MovingEdges::load(const std::uint32_t *e,
                                      EdgeLanes<lanes> &to) const
  {
    using Value = typename Lanes<lanes>::Value;
    Value place[4], size[4];
    Lanes<lanes>::load_four([&](const int l) { return &local_edges[e[l]].x; },
                            place);
    Lanes<lanes>::load_four(
        [&](const int l) { return &local_edges[e[l]].length; }, size);
    to.x               = place[0];
    to.y               = place[1];
    to.tangent[0]      = place[2];
    to.tangent[1]      = place[3];
    to.length          = size[0];
    to.inverse_length  = size[1];
    to.thickness       = size[2];
    to.reference_ratio = size[3];
    Lanes<lanes>::load(reinterpret_cast<const char *>(edge_links.data()),
                       sizeof(Links), e, to.corner[0], to.corner[1]);
  }

  template <int lanes>
  QUOIN_INLINE typename Lanes<lanes>::Bits
  MovingEdges::find_geometry(const PairLanes<lanes> &pairs,
                             const std::uint32_t *ea, const EdgeLanes<lanes> &a,
                             const std::uint32_t *eb, const EdgeLanes<lanes> &b,
                             PairGeometry<lanes> &result) const
  {
    const auto tangent_beside
        = [&](const unsigned int is_a, const unsigned int k,
              typename Lanes<lanes>::Value(&tangent)[2])
    {
      std::uint32_t beside[lanes];
      for (int l = 0; l < lanes; ++l)
        beside[l] = is_a >> l & 1 ? edge_links[ea[l]].neighbours[k]
                                  : edge_links[eb[l]].neighbours[1 - k];
      Lanes<lanes>::load(
          reinterpret_cast<const char *>(local_edges.data()->tangent),
          sizeof(Edge), beside, tangent[0], tangent[1]);
    };
    return PairFunctions<lanes>::find(
        { 1. / parameters.rounding, 1. / parameters.handover }, pairs, a, b,
        tangent_beside, result);
  }
  template <int lanes>
  QUOIN_INLINE void
  MovingEdges::relative_velocity(const std::uint32_t *ea,
                                 const std::uint32_t *eb,
                                 const typename Lanes<lanes>::Value &lower,
                                 const typename Lanes<lanes>::Value &upper,
                                 typename Lanes<lanes>::Value (&rate)[2]) const
  {
    typename Lanes<lanes>::Value v[4][2];
    for (unsigned int n = 0; n < 4; ++n)
    {
      std::uint32_t node[lanes];
      for (int l = 0; l < lanes; ++l)
        node[l] = edge_links[n < 2 ? ea[l] : eb[l]].nodes[n % 2];
      Lanes<lanes>::load(
          reinterpret_cast<const char *>(compact_velocity.data()),
          sizeof(dealii::Tensor<1, 2>), node, v[n][0], v[n][1]);
    }
    for (unsigned int d = 0; d < dim; ++d)
      rate[d] = (1. - upper) * v[2][d] + upper * v[3][d]
                - (1. - lower) * v[0][d] - lower * v[1][d];
  }

  template <int lanes>
  QUOIN_INLINE void MovingEdges::add_to_ends(const EndForceLanes<lanes> &forces,
                                             const std::uint32_t *ea,
                                             const std::uint32_t *eb,
                                             const unsigned int present,
                                             dealii::Tensor<1, 2> *to) const
  {
    // Pair after pair, so that sums do not depend on which are beside which.
    using L = Lanes<lanes>;
    alignas(64) double rows[lanes][8];
    L::store_four(
        [&](const int l) { return rows[l]; },
        { forces.a[0][0], forces.a[0][1], forces.a[1][0], forces.a[1][1] });
    L::store_four(
        [&](const int l) { return rows[l] + 4; },
        { forces.b[0][0], forces.b[0][1], forces.b[1][0], forces.b[1][1] });
    for (int l = 0; l < lanes; ++l)
      if (present >> l & 1)
        for (unsigned int n = 0; n < 4; ++n)
        {
          const Links &edge = edge_links[n < 2 ? ea[l] : eb[l]];
          Lanes<4>::pair(reinterpret_cast<char *>(&to[edge.nodes[n % 2]]))
              += Lanes<4>::pair(
                  reinterpret_cast<const char *>(&rows[l][2 * n]));
        }
  }

  /** Pairs, one in each lane, and their edges. */
  template <int lanes>
  struct PairPack
  {
    std::uint32_t pair[lanes];                /**< indices of NearPairs */
    std::uint32_t lower[lanes], upper[lanes]; /**< edges of MovingEdges */
    EdgeLanes<lanes> a, b;                    /**< those edges */

    /** Takes @p n pairs from @p first on; lanes beyond repeat the last one. */
    QUOIN_INLINE PairPack(const NearPairs &near, const unsigned int *first,
                          const unsigned int n)
    {
      if (n == lanes)
        std::copy_n(first, lanes, pair);
      else
        for (unsigned int l = 0; l < lanes; ++l)
          pair[l] = first[std::min(l, n - 1)];
      for (unsigned int l = 0; l < lanes; ++l)
      {
        lower[l] = near.edges_of(pair[l])[0];
        upper[l] = near.edges_of(pair[l])[1];
      }
      near.moving_edges().load(lower, a);
      near.moving_edges().load(upper, b);
    }
  };
} // namespace quoin

#endif
