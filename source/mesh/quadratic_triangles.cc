// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/quadratic_triangles.h>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace quoin
{
  namespace
  {
    /** The same for both directions of an edge. */
    std::uint64_t edge_key(const unsigned int a, const unsigned int b)
    {
      return (static_cast<std::uint64_t>(std::min(a, b)) << 32)
             | std::max(a, b);
    }
  } // namespace

  void cut_into_quadratic_triangles(MeshData &mesh)
  {
    std::unordered_map<std::uint64_t, unsigned int> midsides;
    midsides.reserve(2 * mesh.triangles.size());
    const auto midside = [&](const unsigned int a, const unsigned int b)
    {
      const auto [place, is_new]
          = midsides.emplace(edge_key(a, b), mesh.vertices.size());
      if (is_new)
        mesh.vertices.emplace_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      return place->second;
    };

    std::vector<std::array<unsigned int, 3>> triangles;
    std::vector<unsigned int> triangle_group;
    triangles.reserve(4 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      const auto &[v0, v1, v2] = mesh.triangles[t];
      const unsigned int m01   = midside(v0, v1);
      const unsigned int m12   = midside(v1, v2);
      const unsigned int m20   = midside(v2, v0);
      triangles.push_back({ { v0, m01, m20 } });
      triangles.push_back({ { v1, m12, m01 } });
      triangles.push_back({ { v2, m20, m12 } });
      triangles.push_back({ { m01, m12, m20 } });
      triangle_group.insert(triangle_group.end(), 4, mesh.triangle_group[t]);
    }

    std::vector<std::array<unsigned int, 2>> lines;
    std::vector<unsigned int> line_name;
    for (std::size_t l = 0; l < mesh.lines.size(); ++l)
    {
      const auto &[a, b] = mesh.lines[l];
      const auto place   = midsides.find(edge_key(a, b));
      if (place == midsides.end())
        lines.push_back(mesh.lines[l]);
      else
      {
        lines.push_back({ { a, place->second } });
        lines.push_back({ { place->second, b } });
      }
      line_name.resize(lines.size(), mesh.line_name[l]);
    }

    mesh.triangles      = std::move(triangles);
    mesh.triangle_group = std::move(triangle_group);
    mesh.lines          = std::move(lines);
    mesh.line_name      = std::move(line_name);
    mesh.quadratic      = true;
  }
} // namespace quoin
