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
#include <map>
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

    /** Distance between two edges [m]; 0 if they cross. */
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

    /** By how much nodes have to move against each other before two edges turn
        until their outward normals enclose a right angle [m]. */
    double motion_to_face(const EdgeEnds &a, const EdgeEnds &b)
    {
      const double ax = a.x[1] - a.x[0], ay = a.y[1] - a.y[0];
      const double bx = b.x[1] - b.x[0], by = b.y[1] - b.y[0];
      const double product = ax * bx + ay * by;
      if (product <= 0.)
        return 0.;
      // Ends that move by d against each other turn an edge of length l by
      // asin(d/l), which is at most pi/2 d/l.
      const double la = std::sqrt(ax * ax + ay * ay);
      const double lb = std::sqrt(bx * bx + by * by);
      return std::asin(std::min(1., product / (la * lb))) * M_2_PI * la * lb
             / (la + lb);
    }

    /** xmin, ymin, xmax, ymax [m]; far inside out: empty. */
    using Bounds         = std::array<double, 4>;
    constexpr double far = std::numeric_limits<double>::max();
    constexpr Bounds nothing{ { far, far, -far, -far } };

    void enclose(const EdgeEnds &edge, Bounds &bounds)
    {
      for (unsigned int k = 0; k < 2; ++k)
      {
        bounds[0] = std::min(bounds[0], edge.x[k]);
        bounds[1] = std::min(bounds[1], edge.y[k]);
        bounds[2] = std::max(bounds[2], edge.x[k]);
        bounds[3] = std::max(bounds[3], edge.y[k]);
      }
    }

    bool are_near(const Bounds &a, const Bounds &b, const double skin)
    {
      for (unsigned int d = 0; d < 2; ++d)
        if (!(a[d] - skin <= b[2 + d] && b[d] - skin <= a[2 + d]))
          return false;
      return true;
    }

    Box box_of(const Bounds &bounds, const double margin)
    {
      return { Point(bounds[0] - margin, bounds[1] - margin),
               Point(bounds[2] + margin, bounds[3] + margin) };
    }

    /** Number of consecutive edges whose common box other ranks see. */
    constexpr unsigned int edges_of_box = 16;

    /** Boxes of edges of one block each. */
    std::vector<Bounds> boxes_of(const ContactEdges &edges,
                                 const std::vector<EdgeEnds> &ends)
    {
      std::vector<Bounds> boxes;
      unsigned int block = ContactEdges::none, n = 0;
      for (const EdgeEnds &edge : ends)
      {
        const unsigned int new_block = edges[edge.edge].block;
        if (new_block != block || n == edges_of_box)
        {
          boxes.push_back(nothing);
          block = new_block;
          n     = 0;
        }
        enclose(edge, boxes.back());
        ++n;
      }
      return boxes;
    }

    /** An edge and where it is, as one rank tells another. */
    struct EdgeThere
    {
      ContactEdge edge;
      std::array<double, 2> x, y;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &edge &x &y;
      }
    };

    /** The edges @p ends that reach into @p boxes, and their neighbours. */
    std::vector<EdgeThere> edges_in(const std::vector<Bounds> &boxes,
                                    const ContactEdges &edges,
                                    const std::vector<EdgeEnds> &ends,
                                    const double skin)
    {
      Bounds all = nothing;
      std::vector<Entry> entries;
      for (unsigned int i = 0; i < boxes.size(); ++i)
      {
        for (unsigned int d = 0; d < 2; ++d)
        {
          all[d]     = std::min(all[d], boxes[i][d]);
          all[2 + d] = std::max(all[2 + d], boxes[i][2 + d]);
        }
        entries.emplace_back(box_of(boxes[i], skin), i);
      }
      const Tree tree(entries);
      std::vector<unsigned int> found;
      const auto add = [&](const unsigned int edge)
      {
        if (edge != ContactEdges::none && edges.is_own(edge))
          found.push_back(edge);
      };
      for (const EdgeEnds &edge : ends)
      {
        Bounds bounds = nothing;
        enclose(edge, bounds);
        if (!are_near(bounds, all, skin)
            || tree.qbegin(bgi::intersects(box_of(edge, 0.))) == tree.qend())
          continue;
        add(edge.edge);
        add(edges[edge.edge].previous);
        add(edges[edge.edge].next);
      }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());

      std::vector<EdgeThere> result;
      auto place = ends.begin();
      for (const unsigned int edge : found)
      {
        while (place->edge < edge)
          ++place;
        result.push_back({ edges[edge],
                           { place->x[0], place->x[1] },
                           { place->y[0], place->y[1] } });
      }
      return result;
    }

    std::vector<EdgeEnds> own_ends(const ContactEdges &edges,
                                   const NodeRecord<2> *nodes,
                                   const AlignedArray<std::uint8_t> &left_out)
    {
      std::vector<EdgeEnds> result;
      result.reserve(edges.own().size());
      for (unsigned int e = 0; e < edges.own().size(); ++e)
      {
        if (left_out[edges.own()[e].block])
          continue;
        EdgeEnds ends;
        ends.edge = edges.own()[e].number;
        for (unsigned int k = 0; k < 2; ++k)
        {
          const NodeRecord<2> &node = nodes[edges.local_nodes()[e][k]];
          ends.x[k]                 = node.X[0] + node.u[0];
          ends.y[k]                 = node.X[1] + node.u[1];
        }
        result.push_back(ends);
      }
      return result;
    }
  } // namespace

  double motion_to_touch(const EdgeEnds &a, const EdgeEnds &b,
                         const double apart)
  {
    return std::max(motion_to_face(a, b), distance(a, b) - apart);
  }

  std::vector<EdgeEnds>
  edges_within_reach(const NodeMap<2> &node_map, ContactEdges &edges,
                     const NodeRecord<2> *nodes,
                     const AlignedArray<std::uint8_t> &left_out,
                     const double skin)
  {
    namespace mpi                = dealii::Utilities::MPI;
    const MPI_Comm communicator  = node_map.communicator();
    const unsigned int n_ranks   = mpi::n_mpi_processes(communicator);
    const unsigned int rank      = mpi::this_mpi_process(communicator);
    std::vector<EdgeEnds> result = own_ends(edges, nodes, left_out);
    if (n_ranks == 1)
      return result;

    // Boxes of ranks, then those of edges to the ranks that are near. What is
    // nearer than the skin is decided later, by both ranks from the same
    // numbers: boxes must not miss it by rounding.
    const double margin = 1.001 * skin;
    std::vector<Bounds> rank_bounds(n_ranks, nothing);
    for (const EdgeEnds &edge : result)
      enclose(edge, rank_bounds[rank]);
    MPI_Allgather(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, rank_bounds.data(), 4,
                  MPI_DOUBLE, communicator);
    std::map<unsigned int, std::vector<Bounds>> boxes_for;
    const std::vector<Bounds> boxes = boxes_of(edges, result);
    for (unsigned int r = 0; r < n_ranks; ++r)
      if (r != rank)
        for (const Bounds &box : boxes)
          if (are_near(box, rank_bounds[r], margin))
            boxes_for[r].push_back(box);

    std::map<unsigned int, std::vector<EdgeThere>> edges_for;
    for (const auto &[r, their_boxes] :
         mpi::some_to_some(communicator, boxes_for))
      edges_for[r] = edges_in(their_boxes, edges, result, margin);
    std::vector<ContactEdge> met;
    for (const auto &[r, theirs] : mpi::some_to_some(communicator, edges_for))
      for (const EdgeThere &there : theirs)
      {
        met.push_back(there.edge);
        result.push_back({ there.edge.number,
                           { there.x[0], there.x[1] },
                           { there.y[0], there.y[1] },
                           false });
      }
    edges.add(met);
    std::sort(result.begin(), result.end(),
              [](const EdgeEnds &a, const EdgeEnds &b)
              { return a.edge < b.edge; });
    return result;
  }

  namespace
  {
    /** Largest number of pairs, of some 220 bytes each. */
    constexpr std::size_t most_pairs = 20000000;

    [[noreturn]] void refuse_pairs(const EdgeEnds &edge, const std::size_t n,
                                   const double skin)
    {
      std::ostringstream message;
      message << "more than " << most_pairs
              << " pairs of edges are nearer than " << skin
              << " m to each other, too many for the contact search. The edge "
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
    std::vector<std::array<unsigned int, 2>> nodes;
    entries.reserve(ends.size());
    nodes.reserve(ends.size());
    for (unsigned int i = 0; i < ends.size(); ++i)
    {
      entries.emplace_back(box_of(ends[i], 0.), i);
      nodes.push_back(edges[ends[i].edge].nodes);
    }
    const Tree tree(entries);

    std::vector<std::array<unsigned int, 2>> pairs;
    for (unsigned int i = 0; i < ends.size(); ++i)
    {
      const auto &[a, b]      = nodes[i];
      const std::size_t first = pairs.size();
      for (auto found = tree.qbegin(bgi::intersects(box_of(ends[i], skin)));
           found != tree.qend(); ++found)
      {
        const unsigned int j = found->second;
        if (j <= i || !(ends[i].is_own || ends[j].is_own))
          continue;
        const auto &[c, d] = nodes[j];
        if (a != c && a != d && b != c && b != d
            && motion_to_face(ends[i], ends[j]) <= skin
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
