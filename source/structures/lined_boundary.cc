// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/number_text.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/structures/lined_boundary.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace quoin
{
  namespace
  {
    using Place = std::array<double, 2>; // in the order of maps

    struct Chain
    {
      std::vector<Place> places;
      bool is_closed = false;
    };

    /** The one line that @p edges are; throws a string that says why they are
        not. */
    Chain chain_of(const std::vector<std::array<Place, 2>> &edges)
    {
      std::map<Place, std::vector<Place>> neighbours;
      const auto connect = [&](const Place &a, const Place &b)
      {
        std::vector<Place> &known = neighbours[a];
        if (std::find(known.begin(), known.end(), b) == known.end())
          known.push_back(b);
      };
      for (const auto &[a, b] : edges)
      {
        connect(a, b);
        connect(b, a);
      }
      const std::string where = " Beams line one curve without branches.";
      Chain chain;
      Place at        = neighbours.begin()->first;
      chain.is_closed = true;
      for (auto &[place, others] : neighbours)
      {
        std::sort(others.begin(), others.end());
        if (others.size() > 2)
          throw "has branches." + where;
        if (others.size() == 1 && chain.is_closed)
        {
          at              = place;
          chain.is_closed = false;
        }
      }
      Place before = at;
      do
      {
        chain.places.push_back(at);
        const auto &others = neighbours[at];
        const Place to
            = others[0] != before || others.size() == 1 ? others[0] : others[1];
        if (others.size() == 1 && chain.places.size() > 1)
          break;
        before = at;
        at     = to;
      } while (at != chain.places.front());
      if (chain.places.size() != neighbours.size())
        throw "has several parts." + where;
      const Place &first = chain.places.front(), &last = chain.places.back();
      double area = 0.;
      for (unsigned int i = 0; i < chain.places.size(); ++i)
      {
        const Place &a = chain.places[i],
                    &b = chain.places[(i + 1) % chain.places.size()];
        area += (a[0] - first[0]) * (b[1] - first[1])
                - (a[1] - first[1]) * (b[0] - first[0]);
      }
      const double x = last[0] - first[0], y = last[1] - first[1];
      if (chain.is_closed                    ? area < 0.
          : std::abs(x) > 1e-9 * std::abs(y) ? x < 0.
                                             : y < 0.)
        std::reverse(chain.places.begin(), chain.places.end());
      return chain;
    }
  } // namespace

  LinedBoundary lined_boundary(const BeamParameters &liner,
                               const NodeMap<2> &nodes,
                               const Thickness &thickness)
  {
    const auto refuse = [&](const std::string &why)
    {
      throw InputError("section 'Beams/" + liner.name
                       + "': 'Boundary = " + liner.boundary + "' " + why);
    };
    const auto &face_names = nodes.table().face_names;
    std::vector<bool> wanted;
    for (const std::string &name : face_names)
      wanted.push_back(name == liner.boundary);
    const auto faces = gather_faces(nodes, wanted, true);
    if (faces.empty())
      refuse("is no curve on the boundary of a block. Curves are: "
             + known_names_like(liner.boundary, face_names) + ".");
    std::vector<std::array<Place, 2>> edges;
    for (const auto &face : faces)
    {
      const auto &a = face.points[0], &b = face.points[1];
      edges.push_back({ { { { a[0], a[1] } }, { { b[0], b[1] } } } });
    }
    LinedBoundary result;
    std::map<Place, unsigned int> number;
    try
    {
      const Chain chain = chain_of(edges);
      result.is_closed  = chain.is_closed;
      for (const Place &p : chain.places)
      {
        number[p] = result.places.size();
        result.places.emplace_back(p[0], p[1]);
      }
    }
    catch (const std::string &why)
    {
      refuse(why);
    }

    result.thickness = thickness[faces[0].group];
    for (const auto &face : faces)
      if (thickness[face.group] != result.thickness)
        refuse(text_of(
            "is that of blocks of different 'Thickness', ", result.thickness,
            " and ", thickness[face.group],
            " m, counting those on both of its sides. Give them the same "
            "one, or a curve and a liner "
            "each."));

    // The cell of a face is on its left.
    std::map<unsigned int, unsigned int> point_of; // by global nodes
    for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const auto &face = faces[f];
      const unsigned int ends[2]
          = { number.at(edges[f][0]), number.at(edges[f][1]) };
      const bool is_forward = (ends[0] + 1) % result.places.size() == ends[1];
      const double length   = face.points[0].distance(face.points[1]);
      if (nodes.table().is_rigid[face.block])
        refuse("belongs to a rigid block. Give it a deformable material, or "
               "line another boundary.");
      for (unsigned int k = 0; k < 2; ++k)
      {
        const auto [found, is_new]
            = point_of.insert({ face.nodes[k], result.points.size() });
        if (is_new)
          result.points.push_back({ nodes.exchange().owns(face.nodes[k])
                                        ? nodes.exchange().local(face.nodes[k])
                                        : NodeMap<2>::none,
                                    face.block, ends[k], is_forward ? 1. : -1.,
                                    0. });
        result.points[found->second].area
            += face.shares[k] * length * thickness[face.group];
      }
    }
    // In an order that does not depend on the ranks.
    std::sort(result.points.begin(), result.points.end(),
              [](const InterfacePoint &a, const InterfacePoint &b) {
                return std::make_pair(a.at, a.block)
                       < std::make_pair(b.at, b.block);
              });
    return result;
  }
} // namespace quoin
