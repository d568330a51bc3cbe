// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/edge_middles.h>
#include <quoin/mesh/halved_edges.h>

#include <utility>

namespace quoin
{
  namespace
  {
    /** Puts what @p parts gives in place of each of @p elements, and as often
        its number in @p group. */
    template <typename Element, typename Parts>
    void divide(std::vector<Element> &elements,
                std::vector<unsigned int> &group, const Parts &parts)
    {
      std::vector<Element> new_elements;
      std::vector<unsigned int> new_group;
      for (std::size_t i = 0; i < elements.size(); ++i)
        for (const Element &part : parts(elements[i]))
        {
          new_elements.push_back(part);
          new_group.push_back(group[i]);
        }
      elements = std::move(new_elements);
      group    = std::move(new_group);
    }
  } // namespace

  void halve_edges(MeshData<2> &mesh, Quadrangles &quadrangles)
  {
    using Line       = std::array<unsigned int, 2>;
    using Triangle   = std::array<unsigned int, 3>;
    using Quadrangle = std::array<unsigned int, 4>;
    EdgeMiddles<2> middle(mesh.vertices);
    divide(mesh.faces, mesh.face_name,
           [&](const Line &n)
           {
             const unsigned int m = middle(n[0], n[1]);
             return std::array<Line, 2>{ { { n[0], m }, { m, n[1] } } };
           });
    divide(mesh.cells, mesh.cell_group,
           [&](const Triangle &n)
           {
             const unsigned int a = middle(n[0], n[1]);
             const unsigned int b = middle(n[1], n[2]);
             const unsigned int c = middle(n[2], n[0]);
             return std::array<Triangle, 4>{
               { { n[0], a, c }, { a, b, c }, { a, n[1], b }, { c, b, n[2] } }
             };
           });
    divide(quadrangles.nodes, quadrangles.group,
           [&](const Quadrangle &n)
           {
             const unsigned int a = middle(n[0], n[1]);
             const unsigned int b = middle(n[1], n[2]);
             const unsigned int c = middle(n[2], n[3]);
             const unsigned int d = middle(n[3], n[0]);
             const unsigned int m = mesh.vertices.size();
             mesh.vertices.push_back(dealii::Point<2>(
                 0.25
                 * (mesh.vertices[n[0]] + mesh.vertices[n[1]]
                    + mesh.vertices[n[2]] + mesh.vertices[n[3]])));
             return std::array<Quadrangle, 4>{ { { n[0], a, m, d },
                                                 { a, n[1], b, m },
                                                 { m, b, n[2], c },
                                                 { d, m, c, n[3] } } };
           });
  }
} // namespace quoin
