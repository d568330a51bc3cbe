// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>
#include <quoin/base/none.h>
#include <quoin/rock/block_borders.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace quoin
{
  namespace
  {
    using SpacePoint  = dealii::Point<3>;
    using SpaceVector = dealii::Tensor<1, 3>;

    /** Sine of the angle below which edges and planes are straight on. */
    constexpr double straight = 1e-7;

    /** Calls @p act(from, to) for each edge of a loop. */
    template <typename Act>
    void for_each_edge(const BlockBorders::Loop &loop, const Act &act)
    {
      for (std::size_t i = 0; i < loop.size(); ++i)
        act(loop[i], loop[(i + 1) % loop.size()]);
    }
  } // namespace

  BlockBorders::BlockBorders(const RockBoxParameters &rock, const RockBox &box)
    : points(box.pieces.vertices()), sizes(points.size(), rock.element_size)
  {
    const auto [number, n] = box.blocks(true);
    groups.assign(n, rock.group);
    for (unsigned int b = 0; b < number.size(); ++b)
      if (const RockBox::Part *part = box.part(b); part && !part->is_hole)
        groups[number[b]] = part->group;

    const auto &faces   = box.pieces.faces();
    const auto block_of = [&number = number](const unsigned int piece)
    { return piece == BlockCutter::none ? none : number[piece]; };
    std::vector<int> surface;
    for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const auto &face = faces[f];
      for (const unsigned int piece : { face.inner, face.outer })
        if (const RockBox::Part *part = box.part(piece);
            part && part->size > 0. && face.surface == RockBox::of_bodies
            && box.is_between_blocks(f))
          for (const unsigned int v : face.loop)
            sizes[v] = std::min(sizes[v], part->size);
      const unsigned int inner = block_of(face.inner);
      const unsigned int outer = block_of(face.outer);
      if (inner == outer)
        continue;
      all.push_back({ { face.loop }, name_of(rock, box, f), { inner, outer } });
      surface.push_back(face.surface);
    }
    if (rock.bodies.empty())
      return;
    unite_borders(surface);
    straighten();
  }

  std::string BlockBorders::name_of(const RockBoxParameters &rock,
                                    const RockBox &box,
                                    const unsigned int f) const
  {
    const auto &face = box.pieces.faces()[f];
    // A void names its whole surface, any other body what it alone has cut.
    for (const unsigned int piece : { face.inner, face.outer })
      if (const RockBox::Part *part = box.part(piece);
          part && (part->is_hole || face.surface == RockBox::of_bodies))
        return part->surface;
    return face.surface < 6 ? rock.sides[face.surface]
                            : rock.sets[face.surface - 6].name;
  }

  SpaceVector BlockBorders::area(const Loop &loop) const
  {
    SpaceVector sum;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += 0.5
             * dealii::cross_product_3d(points[loop[i]] - points[loop[0]],
                                        points[loop[i + 1]] - points[loop[0]]);
    return sum;
  }

  std::map<BlockBorders::Edge, std::vector<unsigned int>>
  BlockBorders::borders_at_edges() const
  {
    std::map<Edge, std::vector<unsigned int>> result;
    for (unsigned int i = 0; i < all.size(); ++i)
      for (const Loop &loop : all[i].loops)
        for_each_edge(loop, [&](const unsigned int a, const unsigned int b)
                      { result[std::minmax(a, b)].push_back(i); });
    return result;
  }

  void BlockBorders::unite_borders(const std::vector<int> &surface)
  {
    std::vector<SpaceVector> normal(all.size());
    for (unsigned int i = 0; i < all.size(); ++i)
    {
      normal[i] = area(all[i].loops[0]);
      normal[i] /= normal[i].norm();
    }
    const auto go_on = [&](const unsigned int i, const unsigned int j)
    {
      const auto [a, b] = all[i].blocks;
      return surface[i] == surface[j] && all[i].name == all[j].name
             && (all[j].blocks == std::array<unsigned int, 2>{ a, b }
                 || all[j].blocks == std::array<unsigned int, 2>{ b, a })
             && dealii::cross_product_3d(normal[i], normal[j]).norm()
                    < straight;
    };
    const auto at_edge = borders_at_edges();
    DisjointSets sets(all.size());
    for (const auto &[edge, at] : at_edge)
      if (at.size() == 2 && go_on(at[0], at[1]))
        sets.unite(at[0], at[1]);
    std::map<unsigned int, std::vector<unsigned int>> members;
    for (unsigned int i = 0; i < all.size(); ++i)
      members[sets.find(i)].push_back(i);
    std::vector<Border> united;
    for (const auto &[first, of] : members)
    {
      Border border;
      if (of.size() == 1 || !unite(of, at_edge, border))
        for (const unsigned int i : of)
          united.push_back(all[i]);
      else
        united.push_back(border);
    }
    all = united;
  }

  bool
  BlockBorders::unite(const std::vector<unsigned int> &members,
                      const std::map<Edge, std::vector<unsigned int>> &at_edge,
                      Border &result) const
  {
    result = all[members[0]];
    // The edges that only one of them has, all around the same way.
    std::set<Edge> edges;
    bool is_simple = true;
    for (const unsigned int i : members)
    {
      const bool is_turned = all[i].blocks != result.blocks;
      for_each_edge(all[i].loops[0],
                    [&](unsigned int a, unsigned int b)
                    {
                      if (is_turned)
                        std::swap(a, b);
                      if (edges.erase({ b, a }) == 0)
                        edges.insert({ a, b });
                      else if (at_edge.at(std::minmax(a, b)).size() > 2)
                        is_simple = false; // a third one ends at that line
                    });
    }
    if (!is_simple)
      return false;
    std::map<unsigned int, unsigned int> next;
    for (const auto &[a, b] : edges)
      if (!next.emplace(a, b).second)
        return false;
    result.loops.clear();
    while (!next.empty())
    {
      Loop loop;
      unsigned int v = next.begin()->first;
      do
      {
        const auto on = next.find(v);
        if (on == next.end())
          return false;
        loop.push_back(v);
        v = on->second;
        next.erase(on);
      } while (v != loop.front());
      result.loops.push_back(loop);
    }
    std::sort(result.loops.begin(), result.loops.end(),
              [&](const Loop &a, const Loop &b)
              { return area(a).norm() > area(b).norm(); });
    return !result.loops.empty();
  }

  void BlockBorders::straighten()
  {
    std::map<unsigned int, std::set<unsigned int>> beside;
    for (const auto &[edge, at] : borders_at_edges())
    {
      beside[edge.first].insert(edge.second);
      beside[edge.second].insert(edge.first);
    }
    std::set<unsigned int> needless;
    for (auto &[v, ends] : beside)
    {
      if (ends.size() != 2)
        continue;
      const unsigned int a = *ends.begin(), b = *ends.rbegin();
      SpaceVector u = points[v] - points[a], w = points[b] - points[v];
      if (dealii::cross_product_3d(u, w).norm() > straight * u.norm() * w.norm()
          || u * w < 0.)
        continue;
      needless.insert(v);
      beside[a].erase(v);
      beside[b].erase(v);
      beside[a].insert(b);
      beside[b].insert(a);
    }
    for (Border &border : all)
      for (Loop &loop : border.loops)
        loop.erase(std::remove_if(loop.begin(), loop.end(),
                                  [&](const unsigned int v)
                                  { return needless.count(v) > 0; }),
                   loop.end());
  }

  double BlockBorders::shortest_edge() const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const auto &[edge, at] : borders_at_edges())
      least = std::min(least, points[edge.first].distance(points[edge.second]));
    return least;
  }

  std::vector<std::vector<std::vector<unsigned int>>>
  BlockBorders::shells() const
  {
    std::vector<std::vector<unsigned int>> borders_of(groups.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      for (const unsigned int b : all[i].blocks)
        if (b != none)
          borders_of[b].push_back(i);
    std::vector<std::vector<std::vector<unsigned int>>> result;
    for (const std::vector<unsigned int> &of : borders_of)
      result.push_back(closed_surfaces(of));
    return result;
  }

  std::vector<std::vector<unsigned int>>
  BlockBorders::closed_surfaces(const std::vector<unsigned int> &of) const
  {
    DisjointSets sets(of.size());
    std::map<Edge, unsigned int> seen;
    for (unsigned int i = 0; i < of.size(); ++i)
      for (const Loop &loop : all[of[i]].loops)
        for_each_edge(loop,
                      [&](const unsigned int a, const unsigned int b)
                      {
                        const auto [it, is_new]
                            = seen.try_emplace(std::minmax(a, b), i);
                        if (!is_new)
                          sets.unite(i, it->second);
                      });
    std::map<unsigned int, std::vector<unsigned int>> surfaces;
    for (unsigned int i = 0; i < of.size(); ++i)
      surfaces[sets.find(i)].push_back(of[i]);
    // The outer one is that with the largest box around it.
    std::vector<std::vector<unsigned int>> result;
    double largest = 0.;
    for (const auto &[first, surface] : surfaces)
    {
      SpacePoint low = points[all[surface[0]].loops[0][0]], high = low;
      for (const unsigned int i : surface)
        for (const unsigned int v : all[i].loops[0])
          for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], points[v][d]);
            high[d] = std::max(high[d], points[v][d]);
          }
      const bool is_outer = low.distance(high) > largest;
      result.insert(is_outer ? result.begin() : result.end(), surface);
      largest = std::max(largest, low.distance(high));
    }
    return result;
  }
} // namespace quoin
