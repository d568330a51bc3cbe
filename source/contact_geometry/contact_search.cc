// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/base/rtree.h>
#include <quoin/contact_geometry/contact_search.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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

    bool cross(const EdgeEnds &a, const EdgeEnds &b)
    {
      const auto side = [](const EdgeEnds &s, const double x, const double y) {
        return (s.x[1] - s.x[0]) * (y - s.y[0])
               - (s.y[1] - s.y[0]) * (x - s.x[0]);
      };
      return side(a, b.x[0], b.y[0]) * side(a, b.x[1], b.y[1]) < 0.
             && side(b, a.x[0], a.y[0]) * side(b, a.x[1], a.y[1]) < 0.;
    }

    /** Square of the distance [m^2] of end @p k of @p a from the edge @p b. */
    double square_distance(const EdgeEnds &a, const unsigned int k,
                           const EdgeEnds &b)
    {
      const double way[2] = { b.x[1] - b.x[0], b.y[1] - b.y[0] };
      const double arm[2] = { a.x[k] - b.x[0], a.y[k] - b.y[0] };
      const double square = way[0] * way[0] + way[1] * way[1];
      const double t      = std::clamp((arm[0] * way[0] + arm[1] * way[1])
                                           / std::max(square, 1e-300),
                                       0., 1.);
      const double x = arm[0] - t * way[0], y = arm[1] - t * way[1];
      return x * x + y * y;
    }

    /** Distance between two edges [m]; 0 if they cross. */
    double distance(const EdgeEnds &a, const EdgeEnds &b)
    {
      if (cross(a, b))
        return 0.;
      return std::sqrt(
          std::min({ square_distance(b, 0, a), square_distance(b, 1, a),
                     square_distance(a, 0, b), square_distance(a, 1, b) }));
    }

    /** The way along an edge [m]. */
    struct EdgeWay
    {
      double x, y, length;

      explicit EdgeWay(const EdgeEnds &edge)
        : x(edge.x[1] - edge.x[0]), y(edge.y[1] - edge.y[0]),
          length(std::sqrt(x * x + y * y))
      {
      }
    };

    /** By how much nodes have to move against each other before two edges turn
        until a contact between them has an area [m]; if it is more than
        @p enough, infinity perhaps. */
    double motion_to_face(const EdgeWay &a, const EdgeWay &b,
                          const double enough)
    {
      static const double least_angle = std::asin(least_contact_cosine);
      const double product            = a.x * b.x + a.y * b.y;
      const double square             = a.length * b.length;
      if (product <= -least_contact_cosine * square)
        return 0.;
      // Ends that move by d against each other turn an edge of length l by
      // asin(d/l), which is at most pi/2 d/l. An angle is not less than its
      // sine.
      const double sum = a.length + b.length;
      if (product > 0.
          && (product + least_angle * square) * M_2_PI
                 > 1.000001 * enough * sum)
        return std::numeric_limits<double>::infinity();
      return (std::asin(std::min(1., product / square)) + least_angle) * M_2_PI
             * a.length * b.length / sum;
    }

    /** xmin, ymin, xmax, ymax [m]; far inside out: empty. */
    constexpr unsigned int dim = 2;
    using Bounds               = std::array<double, 2 * dim>;
    constexpr double far       = std::numeric_limits<double>::max();
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
      for (unsigned int d = 0; d < dim; ++d)
        if (!(a[d] - skin <= b[2 + d] && b[d] - skin <= a[2 + d]))
          return false;
      return true;
    }

    Box box_of(const Bounds &bounds, const double margin)
    {
      return { Point(bounds[0] - margin, bounds[1] - margin),
               Point(bounds[2] + margin, bounds[3] + margin) };
    }

    /** Number of consecutive edges that have a common box. */
    constexpr unsigned int edges_of_box = 16;

    /** Edges that follow each other and the box around them. */
    struct Chain
    {
      unsigned int begin, end; /**< places in a list of edges */
      Bounds bounds;
    };

    /** Chains of the edges of one block each. */
    std::vector<Chain> chains_of(const ContactEdges &edges,
                                 const std::vector<EdgeEnds> &ends)
    {
      std::vector<Chain> chains;
      unsigned int block = ContactEdges::none;
      for (unsigned int i = 0; i < ends.size(); ++i)
      {
        const unsigned int new_block = edges[ends[i].edge].block;
        if (new_block != block || i == chains.back().begin + edges_of_box)
        {
          chains.push_back({ i, i, nothing });
          block = new_block;
        }
        enclose(ends[i], chains.back().bounds);
        ++chains.back().end;
      }
      return chains;
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
        for (unsigned int d = 0; d < dim; ++d)
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
            || tree.qbegin(bgi::intersects(box_of(bounds, 0.))) == tree.qend())
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
    const std::vector<Chain> chains = chains_of(edges, result);
    for (unsigned int r = 0; r < n_ranks; ++r)
      if (r != rank)
        for (const Chain &chain : chains)
          if (are_near(chain.bounds, rank_bounds[r], margin))
            boxes_for[r].push_back(chain.bounds);

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
              << "from " << point_text(dealii::Point<2>(edge.x[0], edge.y[0]))
              << " to " << point_text(dealii::Point<2>(edge.x[1], edge.y[1]))
              << " m is near " << n
              << " more. Let fewer blocks meet at a point, or take "
              << "'Displacements = small' in section 'Contact'.";
      throw RunError(message.str());
    }
  } // namespace

  std::vector<NearEdges> near_edges(const ContactEdges &edges,
                                    const std::vector<EdgeEnds> &ends,
                                    const double skin)
  {
    std::vector<Bounds> bounds(ends.size(), nothing);
    std::vector<std::array<unsigned int, 2>> nodes;
    std::vector<EdgeWay> ways;
    nodes.reserve(ends.size());
    ways.reserve(ends.size());
    for (unsigned int i = 0; i < ends.size(); ++i)
    {
      enclose(ends[i], bounds[i]);
      nodes.push_back(edges[ends[i].edge].nodes);
      ways.emplace_back(ends[i]);
    }
    const std::vector<Chain> chains = chains_of(edges, ends);
    std::vector<Entry> entries;
    entries.reserve(chains.size());
    for (unsigned int c = 0; c < chains.size(); ++c)
      entries.emplace_back(box_of(chains[c].bounds, 0.), c);
    const Tree tree(entries);

    std::vector<NearEdges> pairs;
    pairs.reserve(2 * ends.size());
    std::vector<Entry> found;
    for (const Chain &chain : chains)
    {
      found.clear();
      tree.query(bgi::intersects(box_of(chain.bounds, skin)),
                 std::back_inserter(found));
      std::sort(found.begin(), found.end(),
                [](const Entry &a, const Entry &b)
                { return a.second < b.second; });
      for (unsigned int i = chain.begin; i < chain.end; ++i)
      {
        const auto &[a, b]      = nodes[i];
        const std::size_t first = pairs.size();
        for (const Entry &entry : found)
        {
          const Chain &other = chains[entry.second];
          if (other.end <= i + 1 || !are_near(bounds[i], other.bounds, skin))
            continue;
          for (unsigned int j = std::max(i + 1, other.begin); j < other.end;
               ++j)
          {
            const auto &[c, d] = nodes[j];
            if (!are_near(bounds[i], bounds[j], skin)
                || !(ends[i].is_own || ends[j].is_own) || a == c || a == d
                || b == c || b == d)
              continue;
            const double turn = motion_to_face(ways[i], ways[j], skin);
            if (!(turn <= skin))
              continue;
            const double way = distance(ends[i], ends[j]);
            if (way <= skin)
              pairs.push_back({ { i, j }, turn, way });
          }
        }
        if (pairs.size() > most_pairs)
          refuse_pairs(ends[i], pairs.size() - first, skin);
      }
    }
    return pairs;
  }
} // namespace quoin
