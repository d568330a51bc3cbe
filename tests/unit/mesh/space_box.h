// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_mesh_space_box_h
#define quoin_tests_unit_mesh_space_box_h

#include <quoin/mesh/block_mesh.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace quoin::test
{
  using Count = std::array<unsigned int, 3>;

  /** Vertices of n[0] n[1] n[2] cubes with the edge @p h [m]; x runs first. */
  inline std::vector<dealii::Point<3>>
  box_points(const Count &n, const double h,
             const dealii::Point<3> &origin = dealii::Point<3>())
  {
    std::vector<dealii::Point<3>> result;
    for (unsigned int z = 0; z <= n[2]; ++z)
      for (unsigned int y = 0; y <= n[1]; ++y)
        for (unsigned int x = 0; x <= n[0]; ++x)
          result.push_back(origin + dealii::Point<3>(h * x, h * y, h * z));
    return result;
  }

  /** Tetrahedra of positive volume that divide the cubes of box_points(): six
      each by Kuhn's division, one for each order of the axes. */
  inline std::vector<std::array<unsigned int, 4>> box_cells(const Count &n)
  {
    constexpr unsigned int axes[6][3]
        = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
            { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 } };
    std::vector<std::array<unsigned int, 4>> result;
    Count at;
    for (at[2] = 0; at[2] < n[2]; ++at[2])
      for (at[1] = 0; at[1] < n[1]; ++at[1])
        for (at[0] = 0; at[0] < n[0]; ++at[0])
          for (unsigned int t = 0; t < 6; ++t)
          {
            Count corner = at;
            std::array<unsigned int, 4> cell;
            for (unsigned int k = 0; k < 4; ++k)
            {
              cell[k] = (corner[2] * (n[1] + 1) + corner[1]) * (n[0] + 1)
                        + corner[0];
              if (k < 3)
                ++corner[axes[t][k]];
            }
            if (t > 2) // of odd order
              std::swap(cell[2], cell[3]);
            result.push_back(cell);
          }
    return result;
  }

  /** One block "rock" of n[0] n[1] n[2] cubes with the edge @p h [m], each cut
      into six tetrahedra; its sides are "x0", "x1", "y0", ... */
  inline BlockMesh<3> box_mesh(const Count &n, const double h)
  {
    BlockMesh<3> mesh;
    mesh.group_names        = { "rock" };
    mesh.face_names         = { "", "x0", "x1", "y0", "y1", "z0", "z1" };
    mesh.vertices           = box_points(n, h);
    mesh.cells              = box_cells(n);
    mesh.cell_group         = std::vector<unsigned int>(mesh.n_cells(), 0);
    mesh.block_first_cell   = { 0, mesh.n_cells() };
    mesh.block_first_vertex = { 0, mesh.n_vertices() };
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < 4; ++f)
      {
        std::array<unsigned int, 3> face;
        for (unsigned int k = 0; k < 3; ++k)
          face[k] = mesh.cells[c][(f + 1 + k) % 4];
        for (unsigned int d = 0; d < 3; ++d)
          for (const bool upper : { false, true })
            if (std::all_of(face.begin(), face.end(),
                            [&](const unsigned int v)
                            {
                              const double end = upper ? h * n[d] : 0.;
                              return mesh.vertices[v][d] == end;
                            }))
              mesh.boundary_faces.push_back({ face, c, 1 + 2 * d + upper });
      }
    return mesh;
  }
} // namespace quoin::test

#endif
