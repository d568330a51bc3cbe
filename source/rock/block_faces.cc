// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>
#include <quoin/base/none.h>
#include <quoin/rock/block_faces.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace quoin
{
  namespace
  {
    using Point = dealii::Point<2>;
    /** Parts of the network that hang together. */
    std::vector<unsigned int> find_parts(const JointNetwork &network)
    {
      DisjointSets parts(network.n_vertices());
      for (const auto &edge : network.edges())
        parts.unite(edge.from, edge.to);
      std::vector<unsigned int> part(network.n_vertices());
      for (unsigned int v = 0; v < part.size(); ++v)
        part[v] = parts.find(v);
      return part;
    }
  } // namespace

  BlockFaces::BlockFaces(const JointNetwork &network) : network(network)
  {
    trace_loops();
    find_dead_ends();
    assign_holes();
  }

  void BlockFaces::find_dead_ends()
  {
    std::vector<unsigned int> same;
    std::vector<unsigned int> degree(network.n_vertices(), 0);
    for (unsigned int e = 0; e < network.edges().size(); ++e)
    {
      ++degree[network.edges()[e].from];
      ++degree[network.edges()[e].to];
      if (loop_of[2 * e] == loop_of[2 * e + 1])
        same.push_back(e);
    }
    // What comes loose from its end, one after the other.
    for (bool goes_on = true; goes_on;)
    {
      goes_on = false;
      std::vector<unsigned int> left;
      for (const unsigned int e : same)
      {
        const auto &edge = network.edges()[e];
        if (degree[edge.from] != 1 && degree[edge.to] != 1)
        {
          left.push_back(e);
          continue;
        }
        --degree[edge.from];
        --degree[edge.to];
        dead.push_back(e);
        goes_on = true;
      }
      same = left;
    }
    all_bridges = same;
  }

  std::vector<BlockFaces::Loop> BlockFaces::split(const Loop &loop) const
  {
    std::vector<Loop> simple;
    Loop path;
    std::unordered_map<unsigned int, std::size_t> place; // of start, in path
    for (const unsigned int h : loop)
    {
      const auto seen = place.find(start(h));
      if (seen != place.end())
      {
        const auto begin = path.begin() + seen->second;
        simple.emplace_back(begin, path.end());
        for (auto it = begin; it != path.end(); ++it)
          place.erase(start(*it));
        path.erase(begin, path.end());
      }
      place[start(h)] = path.size();
      path.push_back(h);
    }
    simple.push_back(path);
    return simple;
  }

  Polygon BlockFaces::polygon(const Loop &loop) const
  {
    Polygon result;
    for (const unsigned int h : loop)
      result.push_back(network.point(start(h)));
    return result;
  }

  void BlockFaces::trace_loops()
  {
    // Half-edges that leave each vertex, counter-clockwise.
    const unsigned int n = 2 * network.edges().size();
    std::vector<std::vector<std::pair<double, unsigned int>>> leaving(
        network.n_vertices());
    for (unsigned int h = 0; h < n; ++h)
    {
      const auto way = network.point(start(h ^ 1)) - network.point(start(h));
      leaving[start(h)].emplace_back(std::atan2(way[1], way[0]), h);
    }
    std::vector<unsigned int> next(n, none);
    for (auto &star : leaving)
    {
      std::sort(star.begin(), star.end());
      // Arriving against star[i], the face on the left goes on along the one
      // before it.
      for (std::size_t i = 0; i < star.size(); ++i)
        next[star[i].second ^ 1]
            = star[(i + star.size() - 1) % star.size()].second;
    }

    loop_of.assign(n, none);
    for (unsigned int h = 0; h < n; ++h)
    {
      if (loop_of[h] != none)
        continue;
      Loop loop;
      for (unsigned int i = h; loop_of[i] == none; i = next[i])
      {
        loop_of[i] = loops.size();
        loop.push_back(i);
      }
      loops.push_back(std::move(loop));
    }
  }

  void BlockFaces::assign_holes()
  {
    const auto part_of = find_parts(network);
    std::vector<unsigned int> face_of_loop(loops.size(), outside);
    std::vector<unsigned int> inner, face_part;
    std::vector<std::pair<Box, unsigned int>> boxes;
    for (unsigned int l = 0; l < loops.size(); ++l)
    {
      const double area = signed_area(polygon(loops[l]));
      // A loop that only goes forth and back has no area but for rounding.
      const double length = perimeter(polygon(loops[l]));
      if (area <= 1e-14 * length * length)
      {
        inner.push_back(l);
        continue;
      }
      face_of_loop[l] = all_faces.size();
      all_faces.push_back({ {}, {}, area, length });
      Polygon corners;
      for (const Loop &part : split(loops[l]))
      {
        const Polygon polygon_of_part = polygon(part);
        if (signed_area(polygon_of_part) > 0.)
        {
          all_faces.back().outer = part;
          corners                = polygon_of_part;
        }
        else if (part.size() > 2) // not a dead end
          all_faces.back().inner.push_back(part);
      }
      face_part.push_back(part_of[start(loops[l].front())]);
      const auto box = bounding_box(corners);
      boxes.emplace_back(
          Box(TreePoint(box[0], box[1]), TreePoint(box[2], box[3])),
          outer_polygons.size());
      outer_polygons.push_back(std::move(corners));
    }
    parts = inner.size();

    // Each other loop is the outer border of a part of the network, which is a
    // hole in the smallest face of another part around it.
    tree = { boxes.begin(), boxes.end() };
    for (const unsigned int l : inner)
    {
      const unsigned int vertex = start(loops[l].front());
      const unsigned int found
          = find(network.point(vertex), [&](const unsigned int f)
                 { return face_part[f] != part_of[vertex]; });
      face_of_loop[l] = found;
      if (found == outside)
        continue;
      const Polygon corners = polygon(loops[l]);
      for (const Loop &part : split(loops[l]))
        if (part.size() > 2)
          all_faces[found].inner.push_back(part);
      all_faces[found].area += signed_area(corners);
      all_faces[found].perimeter += perimeter(corners);
    }
    face_of.resize(loop_of.size());
    for (unsigned int h = 0; h < face_of.size(); ++h)
      face_of[h] = face_of_loop[loop_of[h]];
  }

  template <typename IsWanted>
  unsigned int BlockFaces::find(const Point &point,
                                const IsWanted &is_wanted) const
  {
    unsigned int found = outside;
    const TreePoint at(point[0], point[1]);
    const Box here(at, at);
    for (auto it = tree.qbegin(boost::geometry::index::intersects(here));
         it != tree.qend(); ++it)
    {
      const unsigned int f = it->second;
      if (is_wanted(f) && contains(outer_polygons[f], point)
          && (found == outside
              || signed_area(outer_polygons[f])
                     < signed_area(outer_polygons[found])))
        found = f;
    }
    return found;
  }

  unsigned int BlockFaces::find(const Point &point) const
  {
    return find(point, [](const unsigned int) { return true; });
  }

  Point BlockFaces::inner_point(const unsigned int f) const
  {
    unsigned int longest = all_faces[f].outer.front();
    for (const unsigned int h : all_faces[f].outer)
      if (network.length(network.edges()[h / 2])
          > network.length(network.edges()[longest / 2]))
        longest = h;
    const Point a  = network.point(start(longest));
    const Point b  = network.point(start(longest ^ 1));
    const auto way = b - a;
    // Nothing is nearer than the tolerance of the network.
    return Point(a[0] + 0.5 * way[0] - 1e-6 * way[1],
                 a[1] + 0.5 * way[1] + 1e-6 * way[0]);
  }
} // namespace quoin
