// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/mesh/mesh_data.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  void orient_triangles(MeshData &mesh)
  {
    for (auto &triangle : mesh.triangles)
    {
      const auto a = mesh.vertices[triangle[1]] - mesh.vertices[triangle[0]];
      const auto b = mesh.vertices[triangle[2]] - mesh.vertices[triangle[0]];
      const double area            = 0.5 * (a[0] * b[1] - a[1] * b[0]);
      const double longest_squared = std::max(
          { a.norm_square(), b.norm_square(), (b - a).norm_square() });

      // Not a number counts as without area, too.
      if (!(std::abs(area) > 1e-12 * longest_squared))
      {
        std::ostringstream message;
        message << "Mesh '" << mesh.source
                << "': a triangle has no area, with corners";
        for (const unsigned int v : triangle)
          message << " (" << mesh.vertices[v][0] << ", " << mesh.vertices[v][1]
                  << ")";
        message << ". Mesh this place anew, with smaller elements or "
                   "without points that nearly coincide.";
        throw InputError(message.str());
      }
      if (area < 0.)
      {
        std::swap(triangle[1], triangle[2]);
        ++mesh.n_reoriented;
      }
    }
  }

  MeshData curves_of(const MeshData &mesh)
  {
    constexpr unsigned int none = -1;
    MeshData curves;
    curves.group_names = mesh.group_names;
    curves.line_names  = mesh.line_names;
    curves.line_name   = mesh.line_name;
    curves.source      = mesh.source;
    std::vector<unsigned int> number(mesh.vertices.size(), none);
    for (auto line : mesh.lines)
    {
      for (unsigned int &v : line)
      {
        if (number[v] == none)
        {
          number[v] = curves.vertices.size();
          curves.vertices.push_back(mesh.vertices[v]);
        }
        v = number[v];
      }
      curves.lines.push_back(line);
    }
    return curves;
  }
} // namespace quoin
