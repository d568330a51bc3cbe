// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_moving_edges_h
#define quoin_contact_geometry_moving_edges_h

#include <quoin/base/lanes.h>
#include <quoin/base/thickness.h>
#include <quoin/contact_geometry/contact_edges.h>
#include <quoin/contact_geometry/contact_parameters.h>
#include <quoin/contact_geometry/contact_state.h>
#include <quoin/operators/state.h>

#include <array>
#include <memory>
#include <vector>

namespace quoin
{
  template <int lanes>
  struct EdgeLanes;
  template <int lanes>
  struct PairLanes;
  template <int lanes>
  struct PairGeometry;
  template <int lanes>
  struct EndForceLanes;

  /**
   * The edges of the pairs at hand and those beside them, packed, where they
   * are now, with the nodes at their ends. Nodes of own edges come first, then
   * those of foreign edges, which may be the same: forces on the latter are
   * their rank's.
   */
  class MovingEdges
  {
  public:
    static constexpr unsigned int dim = 2;

    static constexpr unsigned int most_lanes = 8;

    /** An edge that takes part, where it is now; see EdgeLanes. */
    struct alignas(64) Edge
    {
      double x, y, tangent[2];
      double length, inverse_length, thickness, reference_ratio;
    };
    /** What it is joined to. */
    struct alignas(32) Links
    {
      double corner[2];            /**< see ContactEdge */
      std::uint32_t nodes[2];      /**< compact */
      std::uint32_t neighbours[2]; /**< edges before and after, or itself */
    };

    /** Keeps references to all but @p thickness, of each cell group. */
    MovingEdges(const NodeMap<2> &nodes, ContactEdges &edges,
                const ContactParameters &parameters,
                const Thickness &thickness);

    /** Takes the edges of @p pairs; those that this rank does not know come
        from theirs, and all others of other ranks are forgotten. Collective. */
    void bind(const AlignedArray<ContactPair> &pairs);

    unsigned int n_edges() const
    {
      return edge_numbers.size();
    }
    /** Index of the edge of this @p number on all ranks. */
    unsigned int local_edge(const unsigned int number) const
    {
      return edges.is_own(number) ? index_of_own[edges.own_place(number)]
                                  : place_of(number);
    }
    const Edge &operator[](const unsigned int edge) const
    {
      return local_edges[edge];
    }
    const Links &links(const unsigned int edge) const
    {
      return edge_links[edge];
    }
    /** Positions of the nodes at the ends of edges, compact [m]. */
    const AlignedArray<dealii::Tensor<1, 2>> &positions() const
    {
      return position;
    }
    /** A bound of what nodes have moved against each other since they were at
        @p from [m]. */
    double motion_since(const AlignedArray<dealii::Tensor<1, 2>> &from) const;
    /** Whether the vertex at end @p k of edge @p e lies within the edges before
        and after edge @p touched. */
    bool vertex_is_inside(unsigned int e, unsigned int k,
                          unsigned int touched) const;

    /** Takes the present positions. */
    void gather(const State<2> &state);
    void gather_velocities(const dealii::Tensor<1, 2> *velocity);
    /** Adds what is in @p from, of the compact nodes, to nodes of own edges,
        and empties that. */
    void scatter(AlignedArray<dealii::Tensor<1, 2>> &from,
                 dealii::Tensor<1, 2> *to) const;

    /** The edges @p e, one for each lane. */
    template <int lanes>
    void load(const std::uint32_t *e, EdgeLanes<lanes> &to) const;
    /** See PairFunctions::find(); @p ea, @p eb: the edges @p a and @p b. */
    template <int lanes>
    typename Lanes<lanes>::Bits
    find_geometry(const PairLanes<lanes> &pairs, const std::uint32_t *ea,
                  const EdgeLanes<lanes> &a, const std::uint32_t *eb,
                  const EdgeLanes<lanes> &b, PairGeometry<lanes> &result) const;
    /** Velocity of places of the edges @p eb against those of @p ea. */
    template <int lanes>
    void relative_velocity(const std::uint32_t *ea, const std::uint32_t *eb,
                           const typename Lanes<lanes>::Value &lower,
                           const typename Lanes<lanes>::Value &upper,
                           typename Lanes<lanes>::Value (&rate)[2]) const;
    /** Adds forces of the lanes @p present to compact nodes. */
    template <int lanes>
    void add_to_ends(const EndForceLanes<lanes> &forces,
                     const std::uint32_t *ea, const std::uint32_t *eb,
                     unsigned int present, dealii::Tensor<1, 2> *to) const;

  private:
    void bind_edges(const AlignedArray<ContactPair> &pairs);
    void bind_nodes();
    unsigned int place_of(unsigned int number) const;
    /** Index of an edge that may be none of those here, then n_edges(). */
    unsigned int find_edge(unsigned int number) const;

    const NodeExchange &exchange;
    ContactEdges &edges;
    const ContactParameters parameters;
    const Thickness thickness;

    std::unique_ptr<NodeExchange> reach;
    std::vector<unsigned int> compact_own; /**< local node of each */
    std::vector<unsigned int> far_nodes;   /**< of foreign edges, global */
    std::vector<NodeRecord<2>> ghost_nodes;
    std::vector<dealii::Tensor<1, 2>> ghost_velocity;
    std::vector<double> reference_lengths;  /**< of the local edges [m] */
    std::vector<double> edge_thickness;     /**< of the cells behind them [m] */
    std::vector<unsigned int> edge_numbers; /**< of the local edges */
    std::vector<unsigned int> index_of_own; /**< of ContactEdges::own() */
    std::vector<unsigned int> index_of_node; /**< compact, of local nodes */
    AlignedArray<dealii::Tensor<1, 2>> position, compact_velocity;
    AlignedArray<Edge> local_edges;
    AlignedArray<Links> edge_links;
  };
} // namespace quoin

#endif
