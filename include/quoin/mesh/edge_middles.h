// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_edge_middles_h
#define quoin_mesh_edge_middles_h

#include <quoin/base/none.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <vector>

namespace quoin
{
  /** Vertices in the middles of edges, which edges of several cells share and
      which are made when they are first asked for. */
  template <int dim>
  class EdgeMiddles
  {
  public:
    /** For edges between those that are in @p vertices now. */
    explicit EdgeMiddles(std::vector<dealii::Point<dim>> &vertices)
      : vertices(vertices), first(vertices.size(), none)
    {
    }

    unsigned int operator()(const unsigned int a, const unsigned int b)
    {
      const auto [low, high] = std::minmax(a, b);
      for (unsigned int e = first[low]; e != none; e = edges[e].next)
        if (edges[e].high == high)
          return edges[e].middle;
      const unsigned int middle = vertices.size();
      vertices.push_back(dealii::Point<dim>(0.5 * (vertices[a] + vertices[b])));
      edges.push_back({ high, middle, first[low] });
      first[low] = edges.size() - 1;
      return middle;
    }

  private:
    /** From a vertex to one of higher number. */
    struct Edge
    {
      unsigned int high, middle;
      unsigned int next; /**< edge of the same vertex */
    };

    std::vector<dealii::Point<dim>> &vertices;
    std::vector<Edge> edges;
    std::vector<unsigned int> first; /**< edge of each vertex */
  };
} // namespace quoin

#endif
