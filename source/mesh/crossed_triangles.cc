// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/plane_geometry.h>
#include <quoin/mesh/crossed_triangles.h>

#include <cmath>

namespace quoin
{
  void add_crossed_triangles(const Quadrangles &quadrangles, MeshData<2> &mesh)
  {
    for (std::size_t q = 0; q < quadrangles.nodes.size(); ++q)
    {
      const auto &n = quadrangles.nodes[q];
      const auto corner
          = [&](const unsigned int i) { return mesh.vertices[n[i % 4]]; };
      const auto add =
          [&](const unsigned int a, const unsigned int b, const unsigned int c)
      {
        mesh.cells.push_back({ { a, b, c } });
        mesh.cell_group.push_back(quadrangles.group[q]);
      };

      // The triangles on either side of each diagonal; a quadrangle is convex
      // if both diagonals have one corner on either side.
      const double b = twice_area(corner(0), corner(1), corner(2));
      const double d = twice_area(corner(0), corner(2), corner(3));
      const double a = twice_area(corner(1), corner(3), corner(0));
      const double c = twice_area(corner(1), corner(2), corner(3));
      if (b * d > 0. && a * c > 0.)
      {
        const double share = b / (b + d); // of the way from 1 to 3
        mesh.vertices.push_back(corner(1) + share * (corner(3) - corner(1)));
        const unsigned int centre = mesh.vertices.size() - 1;
        for (unsigned int i = 0; i < 4; ++i)
          add(n[i], n[(i + 1) % 4], centre);
      }
      else if (b * d > 0.)
      {
        add(n[0], n[1], n[2]);
        add(n[0], n[2], n[3]);
      }
      else
      {
        add(n[1], n[2], n[3]);
        add(n[1], n[3], n[0]);
      }
    }
  }
} // namespace quoin
