// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/base/rtree.h>
#include <quoin/rock/joint_network.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace quoin
{
  namespace
  {
    namespace bg    = boost::geometry;
    namespace bgi   = boost::geometry::index;
    using Point     = dealii::Point<2>;
    using Vector    = dealii::Tensor<1, 2>;
    using TreePoint = bg::model::d2::point_xy<double>;
    using Box       = bg::model::box<TreePoint>;
    using EdgeTree
        = bgi::rtree<std::pair<Box, unsigned int>, bgi::quadratic<16>>;

    /** Share of the tolerance within which a point counts as being there. */
    constexpr double touching = 1e-6;
    /**
     * Share of the tolerance within which an end is joined to an edge.
     * Below 0.7, two corners of a small triangle cannot both be that near to
     * the edges across, which would take turns for ever.
     */
    constexpr double near_edge = 0.6;

    Box box_of(const Point &a, const Point &b, const double margin)
    {
      return {
        TreePoint(std::min(a[0], b[0]) - margin, std::min(a[1], b[1]) - margin),
        TreePoint(std::max(a[0], b[0]) + margin, std::max(a[1], b[1]) + margin)
      };
    }

    /** Where @p p is along the edge, 0 to 1, and how far from its line. */
    std::pair<double, double> foot(const Point &p, const Point &a,
                                   const Point &b)
    {
      const Vector edge = b - a;
      return { (p - a) * edge / edge.norm_square(),
               std::abs(cross(edge, p - a)) / edge.norm() };
    }

    template <typename Edges, typename At>
    EdgeTree tree_of(const Edges &edges, const At &at)
    {
      std::vector<std::pair<Box, unsigned int>> boxes;
      boxes.reserve(edges.size());
      for (unsigned int e = 0; e < edges.size(); ++e)
        boxes.emplace_back(box_of(at(edges[e].from), at(edges[e].to), 0.), e);
      return EdgeTree(boxes.begin(), boxes.end());
    }

    /** Numbers of the entries of @p tree that meet @p box, ascending. */
    template <typename Tree>
    void find(const Tree &tree, const Box &box,
              std::vector<unsigned int> &found)
    {
      found.clear();
      for (auto it = tree.qbegin(bgi::intersects(box)); it != tree.qend(); ++it)
        found.push_back(it->second);
      std::sort(found.begin(), found.end());
    }
  } // namespace

  void JointNetwork::fail(const Point &where, const std::string &what) const
  {
    throw InputError("section 'Rock': near (" + number_text(where[0]) + ", "
                     + number_text(where[1]) + ") m " + what);
  }

  unsigned int JointNetwork::add_vertex(const Point &position,
                                        const bool is_corner)
  {
    Vertex vertex;
    vertex.position  = position;
    vertex.is_corner = is_corner;
    vertices.push_back(vertex);
    return vertices.size() - 1;
  }

  void JointNetwork::add(const Piece &piece, const unsigned int line,
                         const bool is_border)
  {
    Edge edge;
    edge.from   = add_vertex(piece[0], is_border);
    edge.to     = add_vertex(piece[1], is_border);
    edge.line   = line;
    edge.border = is_border ? n_borders++ : none;
    all_edges.push_back(edge);
  }

  void JointNetwork::cut()
  {
    constexpr unsigned int most_rounds = 100;
    join_ends();
    for (unsigned int round = 0; round < most_rounds; ++round)
    {
      const bool has_cut    = cut_edges();
      const bool has_joined = join_ends();
      if (!has_cut && !has_joined)
        return refuse_crossings();
    }
    fail(last_moved,
         "joints cannot be cut at their crossings without moving them more "
         "than 'Shortest edge' again and again. Change it.");
  }

  bool JointNetwork::cut_edges()
  {
    std::vector<std::vector<unsigned int>> cuts(all_edges.size());
    cut_at_crossings(cuts);
    const bool has_moved = cut_at_ends(cuts);
    const bool has_cut   = std::any_of(cuts.begin(), cuts.end(),
                                       [](const auto &c) { return !c.empty(); });
    if (has_cut)
      rebuild(cuts);
    return has_cut || has_moved;
  }

  std::vector<JointNetwork::Crossing> JointNetwork::find_crossings() const
  {
    std::vector<Crossing> result;
    const EdgeTree tree
        = tree_of(all_edges, [&](const unsigned int v) { return point(v); });
    std::vector<unsigned int> near;
    for (unsigned int i = 0; i < all_edges.size(); ++i)
    {
      const Edge &a      = all_edges[i];
      const Point a0     = point(a.from);
      const Vector way_a = point(a.to) - a0;
      find(tree, box_of(a0, point(a.to), 0.), near);
      for (const unsigned int j : near)
      {
        const Edge &b = all_edges[j];
        if (j <= i || a.from == b.from || a.from == b.to || a.to == b.from
            || a.to == b.to)
          continue;
        const Point b0     = point(b.from);
        const Vector way_b = point(b.to) - b0;
        const double det   = cross(way_a, way_b);
        if (det == 0.)
          continue;
        const double s = cross(b0 - a0, way_b) / det;
        const double t = cross(b0 - a0, way_a) / det;
        if (0. < s && s < 1. && 0. < t && t < 1.)
          result.push_back(
              { i, j, a.border != none ? a0 + s * way_a : b0 + t * way_b });
      }
    }
    return result;
  }

  void
  JointNetwork::cut_at_crossings(std::vector<std::vector<unsigned int>> &cuts)
  {
    for (const Crossing &crossing : find_crossings())
    {
      const Edge &a  = all_edges[crossing.first];
      const Edge &b  = all_edges[crossing.second];
      const Point a0 = point(a.from), a1 = point(a.to);
      const Point b0 = point(b.from), b1 = point(b.to);
      // An end so near to the other edge is what they will share.
      const bool both_borders = a.border != none && b.border != none;
      const double near_end
          = std::min(std::min(distance_to_segment(b0, a0, a1),
                              distance_to_segment(b1, a0, a1)),
                     std::min(distance_to_segment(a0, b0, b1),
                              distance_to_segment(a1, b0, b1)));
      if (near_end <= (both_borders ? touching : near_edge) * tolerance)
        continue;
      if (both_borders)
        fail(crossing.where,
             "borders of the outline or of regions cross. Draw regions inside "
             "of the outline, apart from each other or with common edges.");
      const unsigned int v = add_vertex(crossing.where, false);
      vertices[v].border   = a.border != none ? a.border : b.border;
      cuts[crossing.first].push_back(v);
      cuts[crossing.second].push_back(v);
    }
  }

  void JointNetwork::refuse_crossings() const
  {
    for (const Crossing &crossing : find_crossings())
      fail(crossing.where,
           "borders of the outline or of regions are nearer to each other than "
           "'Shortest edge'. Lower it, or draw them farther apart.");
  }

  bool JointNetwork::cut_at_ends(std::vector<std::vector<unsigned int>> &cuts)
  {
    const EdgeTree tree
        = tree_of(all_edges, [&](const unsigned int v) { return point(v); });
    std::vector<bool> in_use(vertices.size(), false);
    for (const Edge &edge : all_edges)
      in_use[edge.from] = in_use[edge.to] = true;
    // Of two ends near each other's edges only one may cut in a round: both
    // would give back the same edges for ever.
    std::vector<bool> has_acted(vertices.size(), false);
    bool has_moved = false;
    std::vector<unsigned int> near;
    const unsigned int n = vertices.size();
    for (unsigned int v = 0; v < n; ++v)
    {
      if (!in_use[v])
        continue;
      find(tree, box_of(point(v), point(v), tolerance), near);
      for (const unsigned int e : near)
      {
        const Edge &edge = all_edges[e];
        if (edge.from == v || edge.to == v)
          continue;
        const Point a = point(edge.from), b = point(edge.to);
        const auto [where, distance] = foot(point(v), a, b);
        if (!(0. < where && where < 1.) || distance > near_edge * tolerance
            || std::min(point(v).distance(a), point(v).distance(b))
                   <= tolerance)
          continue;
        Vertex &vertex     = vertices[v];
        const bool touches = distance <= touching * tolerance;
        if (!touches
            && (has_acted[v] || has_acted[edge.from] || has_acted[edge.to]))
        {
          continue; // there is another round
        }
        if (edge.border != none)
        {
          // Nearly on the border: then it is on it. One border near another
          // is how the user wants it, unless it touches.
          if (!vertex.is_free() && !(touches && vertex.border != edge.border))
            continue;
          if (vertex.is_free())
          {
            vertex.position = a + where * (b - a);
            vertex.border   = edge.border;
            has_moved       = true;
          }
        }
        if (!touches)
        {
          ++joined;
          last_moved   = vertex.position;
          has_acted[v] = has_acted[edge.from] = has_acted[edge.to] = true;
        }
        cuts[e].push_back(v);
      }
    }
    return has_moved;
  }

  void JointNetwork::rebuild(const std::vector<std::vector<unsigned int>> &cuts)
  {
    std::vector<Edge> pieces;
    pieces.reserve(2 * all_edges.size());
    for (unsigned int e = 0; e < all_edges.size(); ++e)
    {
      const Edge edge    = all_edges[e];
      const Point a      = point(edge.from);
      const Vector along = point(edge.to) - a;
      auto chain         = cuts[e];
      std::sort(chain.begin(), chain.end(),
                [&](const unsigned int v, const unsigned int w)
                { return (point(v) - a) * along < (point(w) - a) * along; });
      chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
      chain.insert(chain.begin(), edge.from);
      chain.push_back(edge.to);
      for (std::size_t i = 1; i < chain.size(); ++i)
      {
        Edge piece = edge;
        piece.from = chain[i - 1];
        piece.to   = chain[i];
        pieces.push_back(piece);
      }
    }
    all_edges = std::move(pieces);
    drop_duplicates();
  }

  void JointNetwork::drop_duplicates()
  {
    std::vector<unsigned int> order(all_edges.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](const unsigned int e)
    {
      const Edge &edge = all_edges[e];
      return std::make_tuple(std::min(edge.from, edge.to),
                             std::max(edge.from, edge.to), edge.border == none,
                             edge.line, e);
    };
    std::sort(order.begin(), order.end(),
              [&](const unsigned int a, const unsigned int b)
              { return key(a) < key(b); });
    std::vector<bool> stays(all_edges.size(), false);
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const Edge &edge = all_edges[order[i]];
      if (edge.from == edge.to)
        continue;
      if (i > 0)
      {
        const auto before = key(order[i - 1]), now = key(order[i]);
        if (std::get<0>(before) == std::get<0>(now)
            && std::get<1>(before) == std::get<1>(now))
          continue;
      }
      stays[order[i]] = true;
    }
    std::size_t e = 0;
    remove([&](const Edge &) { return !stays[e++]; });
  }

  bool JointNetwork::may_join(const Vertex &moving, const Vertex &to) const
  {
    if (moving.is_free())
      return true;
    // Points of a border stay on their line or go to a corner, and borders that
    // the user drew close to each other stay apart.
    if (moving.is_corner)
      return to.is_corner
             && moving.position.distance(to.position) <= touching * tolerance;
    if (to.is_corner)
      return true;
    return moving.border == to.border;
  }

  bool JointNetwork::join_ends()
  {
    std::vector<bool> in_use(vertices.size(), false);
    for (const Edge &edge : all_edges)
      in_use[edge.from] = in_use[edge.to] = true;
    std::vector<unsigned int> order;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      if (in_use[v])
        order.push_back(v);
    const auto rank = [&](const unsigned int v) {
      return vertices[v].is_corner ? 0 : vertices[v].border != none ? 1 : 2;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](const unsigned int v, const unsigned int w)
                     { return rank(v) < rank(w); });

    // Points that stay, in squares of the size of the tolerance.
    using Square = std::pair<std::int64_t, std::int64_t>;
    std::map<Square, std::vector<unsigned int>> staying;
    const auto square = [&](const Point &p) {
      return Square(std::floor(p[0] / tolerance), std::floor(p[1] / tolerance));
    };
    std::vector<unsigned int> becomes(vertices.size());
    std::iota(becomes.begin(), becomes.end(), 0);
    bool has_joined = false;
    for (const unsigned int v : order)
    {
      const auto [x, y] = square(point(v));
      double nearest    = std::numeric_limits<double>::max();
      for (std::int64_t i = x - 1; i <= x + 1; ++i)
        for (std::int64_t j = y - 1; j <= y + 1; ++j)
        {
          const auto found = staying.find({ i, j });
          if (found == staying.end())
            continue;
          for (const unsigned int w : found->second)
          {
            const double distance = point(v).distance(point(w));
            if (distance <= tolerance && distance < nearest
                && may_join(vertices[v], vertices[w]))
            {
              nearest    = distance;
              becomes[v] = w;
            }
          }
        }
      if (becomes[v] == v)
        staying[{ x, y }].push_back(v);
      else
      {
        has_joined = true;
        last_moved = point(becomes[v]);
        joined += nearest > touching * tolerance;
      }
    }
    if (!has_joined)
      return false;
    for (Edge &edge : all_edges)
    {
      edge.from = becomes[edge.from];
      edge.to   = becomes[edge.to];
    }
    drop_duplicates();
    return true;
  }

  unsigned int JointNetwork::extend_ends(double &added)
  {
    std::vector<unsigned int> degree(vertices.size(), 0);
    double size = 0.;
    for (const Edge &edge : all_edges)
    {
      ++degree[edge.from];
      ++degree[edge.to];
      size = std::max({ size, std::abs(point(edge.from)[0]),
                        std::abs(point(edge.from)[1]), length(edge) });
    }
    const EdgeTree tree
        = tree_of(all_edges, [&](const unsigned int v) { return point(v); });
    std::vector<Edge> longer;
    unsigned int n_moved = 0;
    std::vector<unsigned int> near;
    for (const Edge &edge : all_edges)
      for (const bool forward : { true, false })
      {
        const unsigned int end   = forward ? edge.to : edge.from;
        const unsigned int start = forward ? edge.from : edge.to;
        if (degree[end] != 1 || edge.border != none)
          continue;
        const Point from = point(end);
        Vector along     = from - point(start);
        along /= along.norm();
        const Point far = from + 4. * size * along;
        double nearest  = std::numeric_limits<double>::max();
        find(tree, box_of(from, far, 0.), near);
        for (const unsigned int e : near)
        {
          const Edge &other = all_edges[e];
          if (other.from == end || other.to == end)
            continue;
          const Point a         = point(other.from);
          const Vector edge_way = point(other.to) - a;
          const double det      = cross(along, edge_way);
          if (det == 0.)
            continue;
          const double reach = cross(a - from, edge_way) / det;
          const double share = cross(a - from, along) / det;
          if (reach > 0. && -1e-9 <= share && share <= 1. + 1e-9)
            nearest = std::min(nearest, reach);
        }
        if (nearest == std::numeric_limits<double>::max())
          continue;
        added += nearest;
        if (nearest <= tolerance)
        {
          // A new end there would be taken back to this one.
          vertices[end].position += nearest * along;
          ++n_moved;
          continue;
        }
        Edge piece = edge;
        piece.from = end;
        piece.to   = add_vertex(from + nearest * along, false);
        longer.push_back(piece);
      }
    all_edges.insert(all_edges.end(), longer.begin(), longer.end());
    if (!longer.empty() || n_moved > 0)
      cut();
    return longer.size() + n_moved;
  }
} // namespace quoin
