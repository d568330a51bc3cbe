// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/contact/contact_search.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace quoin
{
  namespace
  {
    namespace bg  = boost::geometry;
    namespace bgi = boost::geometry::index;
    using Point   = bg::model::d2::point_xy<double>;
    using Box     = bg::model::box<Point>;
    using Entry   = std::pair<Box, unsigned int>;
    using Tree    = bgi::rtree<Entry, bgi::linear<16>>;

    /** Edges whose normals enclose less than 80 degrees never meet. */
    constexpr double facing_cosine = 0.174;

    Box box_of(const EdgeEnds &ends, const double margin)
    {
      return { Point(std::min(ends.x[0], ends.x[1]) - margin,
                     std::min(ends.y[0], ends.y[1]) - margin),
               Point(std::max(ends.x[0], ends.x[1]) + margin,
                     std::max(ends.y[0], ends.y[1]) + margin) };
    }

    dealii::Point<2> end(const EdgeEnds &edge, const unsigned int k)
    {
      return { edge.x[k], edge.y[k] };
    }

    bool cross(const EdgeEnds &a, const EdgeEnds &b)
    {
      const auto side = [](const EdgeEnds &s, const double x, const double y) {
        return (s.x[1] - s.x[0]) * (y - s.y[0])
               - (s.y[1] - s.y[0]) * (x - s.x[0]);
      };
      return side(a, b.x[0], b.y[0]) * side(a, b.x[1], b.y[1]) < 0.
             && side(b, a.x[0], a.y[0]) * side(b, a.x[1], a.y[1]) < 0.;
    }

    bool face_each_other(const EdgeEnds &a, const EdgeEnds &b)
    {
      const double ax = a.x[1] - a.x[0], ay = a.y[1] - a.y[0];
      const double bx = b.x[1] - b.x[0], by = b.y[1] - b.y[0];
      return ax * bx + ay * by
             <= facing_cosine * std::hypot(ax, ay) * std::hypot(bx, by);
    }

    /** xmin, ymin, xmax, ymax of all blocks. */
    std::vector<std::array<double, 4>>
    boxes_of_blocks(const NodeMap<2> &node_map, const ContactEdges &edges,
                    const NodeRecord<2> *nodes)
    {
      // Upper corners with the other sign: one minimum finds both.
      constexpr double far = std::numeric_limits<double>::max();
      std::vector<std::array<double, 4>> boxes(node_map.table().n_blocks(),
                                               { { far, far, far, far } });
      for (const BlockPart &part : node_map.block_parts())
      {
        const unsigned int b = part.number;
        for (unsigned int e = edges.first_edge(b); e < edges.first_edge(b + 1);
             ++e)
        {
          const NodeRecord<2> &node
              = nodes[node_map.exchange().local(edges[e].nodes[0])];
          for (unsigned int d = 0; d < 2; ++d)
          {
            const double x  = node.X[d] + node.u[d];
            boxes[b][d]     = std::min(boxes[b][d], x);
            boxes[b][2 + d] = std::min(boxes[b][2 + d], -x);
          }
        }
      }
      MPI_Allreduce(MPI_IN_PLACE, boxes.data(), 4 * boxes.size(), MPI_DOUBLE,
                    MPI_MIN, node_map.communicator());
      for (auto &box : boxes)
        for (unsigned int d = 2; d < 4; ++d)
          box[d] = -box[d];
      return boxes;
    }

    /** Blocks of other ranks near those of this one, ascending. */
    std::vector<unsigned int>
    blocks_within_reach(const NodeMap<2> &node_map, const ContactEdges &edges,
                        const NodeRecord<2> *nodes,
                        const AlignedArray<std::uint8_t> &left_out,
                        const double skin)
    {
      const auto boxes  = boxes_of_blocks(node_map, edges, nodes);
      const auto box_of = [&](const unsigned int b, const double margin)
      {
        return Box(Point(boxes[b][0] - margin, boxes[b][1] - margin),
                   Point(boxes[b][2] + margin, boxes[b][3] + margin));
      };
      const unsigned int n_blocks = node_map.table().n_blocks();
      std::vector<bool> is_own(n_blocks, false);
      for (const BlockPart &part : node_map.block_parts())
        is_own[part.number] = true;
      std::vector<Entry> entries;
      for (unsigned int b = 0; b < n_blocks; ++b)
        if (is_own[b] && !left_out[b])
          entries.emplace_back(box_of(b, skin), b);
      const Tree tree(entries);
      std::vector<unsigned int> result;
      for (unsigned int b = 0; b < n_blocks; ++b)
        if (!is_own[b] && !left_out[b]
            && tree.qbegin(bgi::intersects(box_of(b, 0.))) != tree.qend())
          result.push_back(b);
      return result;
    }
  } // namespace

  double distance(const EdgeEnds &a, const EdgeEnds &b)
  {
    if (cross(a, b))
      return 0.;
    double nearest = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < 2; ++k)
      nearest = std::min(
          { nearest, distance_to_segment(end(b, k), end(a, 0), end(a, 1)),
            distance_to_segment(end(a, k), end(b, 0), end(b, 1)) });
    return nearest;
  }

  std::vector<EdgeEnds>
  edges_within_reach(const NodeMap<2> &node_map, const ContactEdges &edges,
                     const NodeRecord<2> *nodes,
                     const AlignedArray<std::uint8_t> &left_out,
                     const double skin)
  {
    std::vector<unsigned int> blocks;
    std::vector<unsigned int> ghosts;
    if (dealii::Utilities::MPI::n_mpi_processes(node_map.communicator()) > 1)
    {
      blocks = blocks_within_reach(node_map, edges, nodes, left_out, skin);
      for (const unsigned int b : blocks)
        for (unsigned int e = edges.first_edge(b); e < edges.first_edge(b + 1);
             ++e)
          ghosts.push_back(edges[e].nodes[0]);
      std::sort(ghosts.begin(), ghosts.end());
    }
    for (const BlockPart &part : node_map.block_parts())
      if (!left_out[part.number])
        blocks.push_back(part.number);
    std::sort(blocks.begin(), blocks.end());

    const NodeExchange reach = node_map.exchange().with_partners(ghosts);
    std::vector<NodeRecord<2>> ghost_nodes(ghosts.size());
    reach.update_ghosts(nodes, ghost_nodes.data());

    std::vector<EdgeEnds> result;
    for (const unsigned int b : blocks)
      for (unsigned int e = edges.first_edge(b); e < edges.first_edge(b + 1);
           ++e)
      {
        EdgeEnds ends;
        ends.edge = e;
        for (unsigned int k = 0; k < 2; ++k)
        {
          const unsigned int i      = reach.local(edges[e].nodes[k]);
          const NodeRecord<2> &node = i < reach.n_owned()
                                          ? nodes[i]
                                          : ghost_nodes[i - reach.n_owned()];
          ends.x[k]                 = node.X[0] + node.u[0];
          ends.y[k]                 = node.X[1] + node.u[1];
        }
        result.push_back(ends);
      }
    return result;
  }

  namespace
  {
    /** Of some 220 bytes each. */
    constexpr std::size_t most_pairs = 20000000;

    [[noreturn]] void refuse_pairs(const EdgeEnds &edge, const std::size_t n,
                                   const double skin)
    {
      std::ostringstream message;
      message << "more than " << most_pairs
              << " pairs of edges are nearer than " << skin
              << " m to each other, too many to be watched. The edge "
              << "from (" << edge.x[0] << ", " << edge.y[0] << ") to ("
              << edge.x[1] << ", " << edge.y[1] << ") m is near " << n
              << " more. Let fewer blocks meet at a point, or take "
              << "'Displacements = small' in section 'Contact'.";
      throw RunError(message.str());
    }
  } // namespace

  std::vector<std::array<unsigned int, 2>>
  near_edges(const ContactEdges &edges, const std::vector<EdgeEnds> &ends,
             const double skin)
  {
    std::vector<Entry> entries;
    entries.reserve(ends.size());
    for (unsigned int i = 0; i < ends.size(); ++i)
      entries.emplace_back(box_of(ends[i], 0.), i);
    const Tree tree(entries);

    std::vector<std::array<unsigned int, 2>> pairs;
    for (unsigned int i = 0; i < ends.size(); ++i)
    {
      const auto &[a, b]      = edges[ends[i].edge].nodes;
      const std::size_t first = pairs.size();
      for (auto found = tree.qbegin(bgi::intersects(box_of(ends[i], skin)));
           found != tree.qend(); ++found)
      {
        const unsigned int j = found->second;
        if (j <= i)
          continue;
        const auto &[c, d] = edges[ends[j].edge].nodes;
        if (a != c && a != d && b != c && b != d
            && face_each_other(ends[i], ends[j])
            && distance(ends[i], ends[j]) <= skin)
          pairs.push_back({ { i, j } });
      }
      if (pairs.size() > most_pairs)
        refuse_pairs(ends[i], pairs.size() - first, skin);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }
} // namespace quoin
