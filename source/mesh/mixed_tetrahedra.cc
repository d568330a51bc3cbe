// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/edge_middles.h>
#include <quoin/mesh/mixed_tetrahedra.h>

#include <utility>

namespace quoin
{
  namespace
  {
    /** Appends to @p parts the four cells of the octahedron between the middles
        of the edges of @p cell. */
    void cut_octahedron(const std::array<unsigned int, 4> &cell,
                        const std::vector<dealii::Point<3>> &vertices,
                        EdgeMiddles<3> &middle,
                        std::vector<std::array<unsigned int, 4>> &parts)
    {
      std::array<unsigned int, 4> best = cell;
      double shortest                  = 0.;
      // Diagonals from the middle of edge 0, k to that of the opposite edge.
      for (unsigned int k = 0; k < 3; ++k)
      {
        const std::array<unsigned int, 4> turned
            = { cell[0], cell[1 + k], cell[1 + (k + 1) % 3],
                cell[1 + (k + 2) % 3] };
        const unsigned int from = middle(turned[0], turned[1]),
                           to   = middle(turned[2], turned[3]);
        const double length     = vertices[from].distance_square(vertices[to]);
        if (k == 0 || length < shortest)
        {
          shortest = length;
          best     = turned;
        }
      }
      const auto &[a, b, c, d] = best;
      const std::array<unsigned int, 4> around
          = { middle(a, d), middle(b, d), middle(b, c), middle(a, c) };
      for (unsigned int k = 0; k < 4; ++k)
        parts.push_back(
            { middle(a, b), middle(c, d), around[k], around[(k + 1) % 4] });
    }
  } // namespace

  void make_mixed(MeshData<3> &mesh)
  {
    MeshData<3> cut;
    EdgeMiddles middle(mesh.vertices);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    {
      const auto &cell = mesh.cells[c];
      for (unsigned int k = 0; k < 4; ++k)
      {
        std::array<unsigned int, 4> part;
        for (unsigned int j = 0; j < 4; ++j)
          part[j] = j == k ? cell[k] : middle(cell[k], cell[j]);
        cut.cells.push_back(part);
      }
      cut_octahedron(cell, mesh.vertices, middle, cut.cells);
      cut.cell_group.resize(cut.cells.size(), mesh.cell_group[c]);
    }
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
    {
      const auto &[a, b, c] = mesh.faces[f];
      const unsigned int ab = middle(a, b), bc = middle(b, c),
                         ca = middle(c, a);
      for (const auto &part : { std::array<unsigned int, 3>{ a, ab, ca },
                                { ab, b, bc },
                                { ca, bc, c },
                                { ab, bc, ca } })
        cut.faces.push_back(part);
      cut.face_name.resize(cut.faces.size(), mesh.face_name[f]);
    }
    mesh.cells      = std::move(cut.cells);
    mesh.cell_group = std::move(cut.cell_group);
    mesh.faces      = std::move(cut.faces);
    mesh.face_name  = std::move(cut.face_name);
    mesh.mixed      = true;
  }
} // namespace quoin
