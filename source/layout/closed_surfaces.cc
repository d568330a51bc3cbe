// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/none.h>
#include <quoin/base/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "closed_surfaces.h"

namespace quoin
{
  namespace
  {
    using SpacePoint  = dealii::Point<3>;
    using SpaceVector = dealii::Tensor<1, 3>;
    using Edge        = std::pair<unsigned int, unsigned int>;

    void keep_used_points(FacetSoup &soup)
    {
      std::vector<unsigned int> place(soup.points.size(), none);
      std::vector<SpacePoint> points;
      for (Facet &facet : soup.facets)
        for (unsigned int &corner : facet.corners)
        {
          if (place[corner] == none)
          {
            place[corner] = points.size();
            points.push_back(soup.points[corner]);
          }
          corner = place[corner];
        }
      soup.points = points;
    }

    /** Makes points closer than @p tolerance [m] one. */
    void merge_points(FacetSoup &soup, const double tolerance)
    {
      using Cell = std::array<long, 3>;
      std::map<Cell, std::vector<unsigned int>> cells;
      std::vector<SpacePoint> points;
      std::vector<unsigned int> place(soup.points.size(), none);
      const auto find = [&](const SpacePoint &p, const Cell &cell)
      {
        Cell near;
        for (near[0] = cell[0] - 1; near[0] <= cell[0] + 1; ++near[0])
          for (near[1] = cell[1] - 1; near[1] <= cell[1] + 1; ++near[1])
            for (near[2] = cell[2] - 1; near[2] <= cell[2] + 1; ++near[2])
              if (const auto found = cells.find(near); found != cells.end())
                for (const unsigned int q : found->second)
                  if (points[q].distance(p) < tolerance)
                    return q;
        return none;
      };
      for (unsigned int v = 0; v < soup.points.size(); ++v)
      {
        const SpacePoint &p = soup.points[v];
        Cell cell;
        for (unsigned int d = 0; d < 3; ++d)
          cell[d] = std::lround(p[d] / tolerance);
        place[v] = find(p, cell);
        if (place[v] == none)
        {
          place[v] = points.size();
          cells[cell].push_back(points.size());
          points.push_back(p);
        }
      }
      soup.points = points;
      std::vector<Facet> facets;
      for (Facet &facet : soup.facets)
      {
        std::vector<unsigned int> corners;
        for (const unsigned int v : facet.corners)
          if (corners.empty() || corners.back() != place[v])
            corners.push_back(place[v]);
        while (corners.size() > 1 && corners.front() == corners.back())
          corners.pop_back();
        facet.corners = corners;
        if (corners.size() > 2) // else it was a sliver
          facets.push_back(facet);
      }
      soup.facets = facets;
    }

    /** Normal of a loop times twice its area [m^2]. */
    SpaceVector area_of(const std::vector<SpacePoint> &points,
                        const std::vector<unsigned int> &loop)
    {
      SpaceVector area;
      for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        area += cross_product_3d(points[loop[i]] - points[loop[0]],
                                 points[loop[i + 1]] - points[loop[0]]);
      return area;
    }

    /** Cuts facets that are not plane into triangles, and leaves out those
        without area. */
    void flatten(FacetSoup &soup, const double tolerance)
    {
      std::vector<Facet> facets;
      for (const Facet &facet : soup.facets)
      {
        const auto &corners    = facet.corners;
        const SpaceVector area = area_of(soup.points, corners);
        if (area.norm() <= tolerance * tolerance)
          continue;
        const SpaceVector normal = area / area.norm();
        const bool is_plane      = std::all_of(
                 corners.begin(), corners.end(),
                 [&](const unsigned int v)
                 {
              return std::abs(normal
                                   * (soup.points[v] - soup.points[corners[0]]))
                     <= tolerance;
            });
        if (is_plane)
          facets.push_back(facet);
        else
          for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            facets.push_back({ { corners[0], corners[i], corners[i + 1] },
                               facet.object,
                               facet.group });
      }
      soup.facets = facets;
    }

    /** Facets of an object and the edges between them. */
    class Shells
    {
    public:
      Shells(const FacetSoup &soup, const std::vector<unsigned int> &facets,
             const std::string &file)
        : soup(soup), facets(facets), file(file)
      {
        for (unsigned int f = 0; f < facets.size(); ++f)
          for_edges(f,
                    [&](const Edge &edge) { at[sorted(edge)].push_back(f); });
        for (const auto &[edge, of] : at)
          if (of.size() != 2)
            fail(edge, of);
        shell.assign(facets.size(), none);
        reversed.assign(facets.size(), false);
        for (unsigned int f = 0; f < facets.size(); ++f)
          if (shell[f] == none)
            orient(f);
        find_patches();
      }

      void append_to(BlockSurfaces &result) const
      {
        const std::size_t first = result.blocks.size();
        result.blocks.resize(first + n_shells);
        std::map<unsigned int, std::vector<unsigned int>> patches;
        for (unsigned int f = 0; f < facets.size(); ++f)
        {
          patches[patch[f]].push_back(f);
          const Facet &facet          = soup.facets[facets[f]];
          BlockSurfaces::Block &block = result.blocks[first + shell[f]];
          if (!block.group.empty() && block.group != facet.group)
            throw InputError(
                "Mesh '" + file + "': "
                + (facet.object.empty() ? "a block"
                                        : "block '" + facet.object + "'")
                + " has the materials '" + block.group + "' and '" + facet.group
                + "'. Give all faces of a block one material.");
          block.group = facet.group;
          block.volume += (reversed[f] ? -1. : 1.)
                          * (area_of(soup.points, facet.corners)
                             * soup.points[facet.corners[0]])
                          / 6.;
        }
        for (const auto &[seed, members] : patches)
          append_patch(members, result.blocks[first + shell[seed]]);
        for (std::size_t b = first; b < result.blocks.size(); ++b)
          result.blocks[b].volume = std::abs(result.blocks[b].volume);
      }

    private:
      static Edge sorted(const Edge &edge)
      {
        return std::minmax(edge.first, edge.second);
      }

      /** Calls @p use with the edges of facet @p f, as it is turned. */
      template <typename Use>
      void for_edges(const unsigned int f, const Use &use) const
      {
        const auto &corners = soup.facets[facets[f]].corners;
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
          const unsigned int a = corners[i],
                             b = corners[(i + 1) % corners.size()];
          use(!reversed.empty() && reversed[f] ? Edge(b, a) : Edge(a, b));
        }
      }

      [[noreturn]] void fail(const Edge &edge,
                             const std::vector<unsigned int> &of) const
      {
        const auto text = [&](const unsigned int v)
        {
          const SpacePoint &p = soup.points[v];
          return "(" + number_text(p[0]) + ", " + number_text(p[1]) + ", "
                 + number_text(p[2]) + ")";
        };
        const std::string object = soup.facets[facets[of[0]]].object;
        throw InputError(
            "Mesh '" + file + "': the surface of "
            + (object.empty() ? "a block" : "block '" + object + "'")
            + " is not closed: " + std::to_string(of.size())
            + (of.size() == 1 ? " face has" : " faces have") + " the edge from "
            + text(edge.first) + " to " + text(edge.second)
            + ", and there must be two. Close it in the program "
              "that wrote the file; give blocks that touch "
              "objects of their own.");
      }

      /** Turns the facets that hang together with @p seed as that one. */
      void orient(const unsigned int seed)
      {
        std::vector<unsigned int> open = { seed };
        shell[seed]                    = n_shells;
        while (!open.empty())
        {
          const unsigned int f = open.back();
          open.pop_back();
          for_edges(f,
                    [&](const Edge &edge)
                    {
                      const auto &of       = at.at(sorted(edge));
                      const unsigned int g = of[0] == f ? of[1] : of[0];
                      if (shell[g] != none)
                        return;
                      shell[g] = n_shells;
                      for_edges(g,
                                [&](const Edge &other) {
                                  reversed[g] = reversed[g] || other == edge;
                                });
                      open.push_back(g);
                    });
        }
        ++n_shells;
      }

      SpaceVector normal(const unsigned int f) const
      {
        const SpaceVector area
            = area_of(soup.points, soup.facets[facets[f]].corners);
        return (reversed[f] ? -1. : 1.) / area.norm() * area;
      }

      /** Numbers facets that hang together in one plane. */
      void find_patches()
      {
        patch.assign(facets.size(), none);
        for (unsigned int seed = 0; seed < facets.size(); ++seed)
        {
          if (patch[seed] != none)
            continue;
          const SpaceVector n            = normal(seed);
          std::vector<unsigned int> open = { seed };
          patch[seed]                    = seed;
          while (!open.empty())
          {
            const unsigned int f = open.back();
            open.pop_back();
            for_edges(f,
                      [&](const Edge &edge)
                      {
                        for (const unsigned int g : at.at(sorted(edge)))
                          if (patch[g] == none && (normal(g) - n).norm() < 1e-5)
                          {
                            patch[g] = seed;
                            open.push_back(g);
                          }
                      });
          }
        }
      }

      /** The outlines of facets in one plane as a face, or the facets one by
          one if outlines meet in a point. */
      void append_patch(const std::vector<unsigned int> &members,
                        BlockSurfaces::Block &block) const
      {
        std::map<unsigned int, unsigned int> next;
        bool is_simple = true;
        for (const unsigned int f : members)
          for_edges(f,
                    [&](const Edge &edge)
                    {
                      const auto &of       = at.at(sorted(edge));
                      const unsigned int g = of[0] == f ? of[1] : of[0];
                      if (patch[g] != patch[f])
                        is_simple = next.insert(edge).second && is_simple;
                    });
        if (!is_simple)
        {
          for (const unsigned int f : members)
            block.faces.push_back({ { soup.facets[facets[f]].corners } });
          return;
        }
        BlockSurfaces::Face face;
        while (!next.empty())
        {
          BlockSurfaces::Loop loop;
          for (auto at_end = next.begin(); at_end != next.end();)
          {
            loop.push_back(at_end->first);
            const unsigned int to = at_end->second;
            next.erase(at_end);
            at_end = next.find(to);
          }
          face.loops.push_back(loop);
        }
        // Holes lie in the largest one.
        std::sort(face.loops.begin(), face.loops.end(),
                  [&](const auto &a, const auto &b) {
                    return area_of(soup.points, a).norm()
                           > area_of(soup.points, b).norm();
                  });
        block.faces.push_back(face);
      }

      const FacetSoup &soup;
      const std::vector<unsigned int> &facets;
      const std::string &file;
      std::map<Edge, std::vector<unsigned int>> at; /**< facets at each edge */
      std::vector<unsigned int> shell, patch;       /**< of each facet */
      std::vector<bool> reversed;
      unsigned int n_shells = 0;
    };
  } // namespace

  BlockSurfaces closed_surfaces(FacetSoup &soup, const std::string &file)
  {
    keep_used_points(soup);
    double extent = 0.;
    for (const SpacePoint &p : soup.points)
      extent = std::max(extent, p.distance(soup.points[0]));
    if (extent > 0.)
      merge_points(soup, 1e-6 * extent);
    flatten(soup, 1e-6 * extent);
    if (soup.facets.empty())
      throw InputError("Mesh '" + file + "': there is no block in it.");
    std::map<std::string, std::vector<unsigned int>> objects;
    std::vector<std::string> order;
    for (unsigned int f = 0; f < soup.facets.size(); ++f)
    {
      auto &members = objects[soup.facets[f].object];
      if (members.empty())
        order.push_back(soup.facets[f].object);
      members.push_back(f);
    }
    BlockSurfaces result;
    for (const std::string &object : order)
      Shells(soup, objects[object], file).append_to(result);
    result.points    = soup.points;
    result.n_ignored = soup.n_ignored;
    return result;
  }
} // namespace quoin
