// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/rock/block_cutter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace quoin
{
  namespace
  {
    using SpacePoint  = dealii::Point<3>;
    using SpaceVector = dealii::Tensor<1, 3>;

    SpaceVector area_vector(const std::vector<SpacePoint> &loop)
    {
      SpaceVector sum;
      for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        sum += 0.5
               * dealii::cross_product_3d(loop[i] - loop[0],
                                          loop[i + 1] - loop[0]);
      return sum;
    }

    /** The part of a convex polygon on the upper side of @p plane. */
    std::vector<SpacePoint> clipped(const std::vector<SpacePoint> &loop,
                                    const JointPlane &plane)
    {
      std::vector<SpacePoint> part;
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        const SpacePoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
        const double da = plane.distance(a), db = plane.distance(b);
        if (da >= 0.)
          part.push_back(a);
        if ((da < 0.) != (db < 0.))
          part.push_back(a + da / (da - db) * (b - a));
      }
      return part;
    }
  } // namespace

  BlockCutter::BlockCutter(const SpacePoint &low, const SpacePoint &high,
                           const double shortest_edge,
                           const double smallest_block)
    : shortest_edge(shortest_edge), smallest_block(smallest_block),
      tolerance(1e-10 * low.distance(high)), blocks(1)
  {
    for (unsigned int v = 0; v < 8; ++v)
      points.emplace_back(v & 1 ? high[0] : low[0], v & 2 ? high[1] : low[1],
                          v & 4 ? high[2] : low[2]);
    const std::array<std::vector<unsigned int>, 6> loops
        = { { { 0, 4, 6, 2 },
              { 1, 3, 7, 5 },
              { 0, 1, 5, 4 },
              { 2, 6, 7, 3 },
              { 0, 2, 3, 1 },
              { 4, 5, 7, 6 } } };
    for (unsigned int f = 0; f < 6; ++f)
    {
      all_faces.push_back({ loops[f], f, 0, none });
      blocks[0].insert(f);
      enter_edges(f, true);
    }
  }

  void BlockCutter::enter_edges(const unsigned int face, const bool there)
  {
    const auto &loop = all_faces[face].loop;
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const Edge edge = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      if (there)
        faces_at[edge].insert(face);
      else if (auto &at = faces_at[edge]; at.erase(face) > 0 && at.empty())
        faces_at.erase(edge);
    }
  }

  int BlockCutter::side(const unsigned int vertex,
                        const JointPlane &plane) const
  {
    const double distance = plane.distance(points[vertex]);
    return std::abs(distance) <= tolerance ? 0 : distance > 0. ? 1 : -1;
  }

  std::vector<SpacePoint> BlockCutter::corners(const unsigned int face) const
  {
    std::vector<SpacePoint> result;
    for (const unsigned int v : all_faces[face].loop)
      result.push_back(points[v]);
    return result;
  }

  SpaceVector BlockCutter::area(const unsigned int face) const
  {
    return area_vector(corners(face));
  }

  double BlockCutter::volume(const unsigned int block) const
  {
    // Pyramids from a vertex of the block, which far origins do not blur.
    const SpacePoint apex = points[all_faces[*blocks[block].begin()].loop[0]];
    double sum            = 0.;
    for (const unsigned int f : blocks[block])
    {
      const auto loop = corners(f);
      sum += std::abs(area_vector(loop) * (loop[0] - apex)) / 3.;
    }
    return sum;
  }

  std::pair<double, double> BlockCutter::volumes(const unsigned int block,
                                                 const JointPlane &plane) const
  {
    // With an apex in the plane, the face that the cut makes adds nothing.
    SpacePoint apex = points[all_faces[*blocks[block].begin()].loop[0]];
    apex -= plane.distance(apex) * plane.normal;
    double above = 0.;
    for (const unsigned int f : blocks[block])
    {
      const auto loop = clipped(corners(f), plane);
      if (loop.size() > 2)
        above += (all_faces[f].inner == block ? 1. : -1.)
                 * (area_vector(loop) * (loop[0] - apex)) / 3.;
    }
    return { volume(block) - above, above };
  }

  double BlockCutter::section(const unsigned int block,
                              const JointPlane &plane) const
  {
    // The faces above the plane and the section close the upper part.
    SpaceVector sum;
    for (const unsigned int f : blocks[block])
    {
      const auto loop = clipped(corners(f), plane);
      if (loop.size() > 2)
        sum += (all_faces[f].inner == block ? 1. : -1.) * area_vector(loop);
    }
    return sum.norm();
  }

  bool BlockCutter::may_cut(const unsigned int block,
                            const JointPlane &plane) const
  {
    for (const unsigned int f : blocks[block])
    {
      const auto &loop = all_faces[f].loop;
      std::vector<SpacePoint> in_plane;
      bool has_below = false, has_above = false;
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        const SpacePoint &a = points[loop[i]];
        const SpacePoint &b = points[loop[(i + 1) % loop.size()]];
        const int at_a      = side(loop[i], plane);
        const int at_b      = side(loop[(i + 1) % loop.size()], plane);
        has_below           = has_below || at_a < 0;
        has_above           = has_above || at_a > 0;
        if (at_a == 0)
          in_plane.push_back(a);
        if (at_a * at_b >= 0)
          continue;
        const double da    = plane.distance(a);
        const double share = da / (da - plane.distance(b));
        if (std::min(share, 1. - share) * a.distance(b) < shortest_edge)
          return false;
        in_plane.push_back(a + share * (b - a));
      }
      // A face on both sides is left with two points of the plane, no more,
      // between which there is a new edge.
      if (has_below && has_above
          && (in_plane.size() != 2
              || in_plane[0].distance(in_plane[1]) < shortest_edge))
        return false;
    }
    const auto [below, above] = volumes(block, plane);
    return std::min(below, above) >= smallest_block
           && std::min(below, above) > 0.;
  }

  void BlockCutter::cut_edges(const unsigned int block, const JointPlane &plane)
  {
    std::set<Edge> edges;
    for (const unsigned int f : blocks[block])
    {
      const auto &loop = all_faces[f].loop;
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        const unsigned int a = loop[i], b = loop[(i + 1) % loop.size()];
        if (side(a, plane) * side(b, plane) < 0)
          edges.insert(std::minmax(a, b));
      }
    }
    for (const auto &[a, b] : edges)
    {
      const double da                 = plane.distance(points[a]);
      const double db                 = plane.distance(points[b]);
      const unsigned int vertex       = points.size();
      const std::set<unsigned int> at = faces_at.at({ a, b });
      points.push_back(points[a] + da / (da - db) * (points[b] - points[a]));
      for (const unsigned int f : at)
      {
        enter_edges(f, false);
        auto &loop = all_faces[f].loop;
        for (std::size_t i = 0; i < loop.size(); ++i)
          if (Edge(std::minmax(loop[i], loop[(i + 1) % loop.size()]))
              == Edge(a, b))
          {
            loop.insert(loop.begin() + i + 1, vertex);
            break;
          }
        enter_edges(f, true);
      }
    }
  }

  void BlockCutter::split_face(const unsigned int face, const std::size_t from,
                               const std::size_t to)
  {
    enter_edges(face, false);
    Face other         = all_faces[face];
    const auto loop    = other.loop;
    const auto new_one = static_cast<unsigned int>(all_faces.size());
    other.loop.assign(loop.begin() + from, loop.begin() + to + 1);
    auto &rest = all_faces[face].loop;
    rest.assign(loop.begin(), loop.begin() + from + 1);
    rest.insert(rest.end(), loop.begin() + to, loop.end());
    for (const unsigned int block : { other.inner, other.outer })
      if (block != none)
        blocks[block].insert(new_one);
    all_faces.push_back(std::move(other));
    enter_edges(face, true);
    enter_edges(new_one, true);
  }

  void BlockCutter::cut_faces(const unsigned int block, const JointPlane &plane)
  {
    const std::set<unsigned int> before = blocks[block];
    for (const unsigned int f : before)
    {
      const auto &loop = all_faces[f].loop;
      bool has_below = false, has_above = false;
      std::vector<std::size_t> in_plane;
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        const int at = side(loop[i], plane);
        has_below    = has_below || at < 0;
        has_above    = has_above || at > 0;
        if (at == 0)
          in_plane.push_back(i);
      }
      if (has_below && has_above)
        split_face(f, in_plane.front(), in_plane.back());
    }
  }

  std::vector<unsigned int>
  BlockCutter::cut_loop(const unsigned int block,
                        const std::set<unsigned int> &above) const
  {
    // The edges that only one face of the upper part has, against the way that
    // this face goes around the part.
    std::map<unsigned int, unsigned int> next;
    for (const unsigned int f : above)
    {
      const auto &loop = all_faces[f].loop;
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        unsigned int a = loop[i], b = loop[(i + 1) % loop.size()];
        unsigned int n = 0;
        for (const unsigned int g : faces_at.at(std::minmax(a, b)))
          n += above.count(g);
        if (n != 1)
          continue;
        if (all_faces[f].inner == block)
          std::swap(a, b);
        next[a] = b;
      }
    }
    std::vector<unsigned int> loop = { next.begin()->first };
    while (next.at(loop.back()) != loop.front())
      loop.push_back(next.at(loop.back()));
    return loop;
  }

  BlockCutter::Result BlockCutter::try_cut(const unsigned int block,
                                           const JointPlane &plane) const
  {
    bool has_below = false, has_above = false;
    for (const unsigned int f : blocks[block])
      for (const unsigned int v : all_faces[f].loop)
      {
        has_below = has_below || side(v, plane) < 0;
        has_above = has_above || side(v, plane) > 0;
      }
    if (!has_below || !has_above)
      return missed;
    return may_cut(block, plane) ? cut : refused;
  }

  BlockCutter::Result BlockCutter::cut_block(const unsigned int block,
                                             const JointPlane &plane,
                                             const unsigned int surface)
  {
    if (const Result result = try_cut(block, plane); result != cut)
      return result;
    cut_edges(block, plane);
    cut_faces(block, plane);

    std::set<unsigned int> above, below;
    for (const unsigned int f : blocks[block])
    {
      const auto &loop    = all_faces[f].loop;
      const bool is_above = std::any_of(loop.begin(), loop.end(),
                                        [&](const unsigned int v)
                                        { return side(v, plane) > 0; });
      (is_above ? above : below).insert(f);
    }
    const unsigned int new_block = blocks.size();
    const unsigned int new_face  = all_faces.size();
    all_faces.push_back({ cut_loop(block, above), surface, new_block, block });
    enter_edges(new_face, true);
    for (const unsigned int f : above)
      (all_faces[f].inner == block ? all_faces[f].inner : all_faces[f].outer)
          = new_block;
    above.insert(new_face);
    below.insert(new_face);
    blocks[block] = std::move(below);
    blocks.push_back(std::move(above));
    return cut;
  }
} // namespace quoin
