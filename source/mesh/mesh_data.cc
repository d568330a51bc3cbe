// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/mesh/mesh_data.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Volume of the simplex whose edges from its first vertex are @p edges,
        an area in two dimensions; positive if they turn by the right hand. */
    template <int dim>
    double signed_volume(const std::array<dealii::Tensor<1, dim>, dim> &edges)
    {
      if constexpr (dim == 2)
        return 0.5 * (edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]);
      else
        return dealii::cross_product_3d(edges[0], edges[1]) * edges[2] / 6.;
    }
  } // namespace

  template <int dim>
  void orient_cells(MeshData<dim> &mesh)
  {
    for (auto &cell : mesh.cells)
    {
      std::array<dealii::Tensor<1, dim>, dim> edges;
      double longest_squared = 0.;
      for (unsigned int i = 0; i < dim; ++i)
      {
        edges[i]        = mesh.vertices[cell[i + 1]] - mesh.vertices[cell[0]];
        longest_squared = std::max(longest_squared, edges[i].norm_square());
        for (unsigned int j = 0; j < i; ++j)
          longest_squared
              = std::max(longest_squared, (edges[i] - edges[j]).norm_square());
      }
      const double volume = signed_volume<dim>(edges);
      const double cube   = dim == 2
                                ? longest_squared
                                : longest_squared * std::sqrt(longest_squared);

      // Not a number counts as without volume, too.
      if (!(std::abs(volume) > 1e-12 * cube))
      {
        std::ostringstream message;
        message << "Mesh '" << mesh.source << "': a "
                << (dim == 2 ? "triangle has no area"
                             : "tetrahedron has no volume")
                << ", with corners";
        for (const unsigned int v : cell)
        {
          message << " (" << mesh.vertices[v][0];
          for (unsigned int d = 1; d < dim; ++d)
            message << ", " << mesh.vertices[v][d];
          message << ")";
        }
        message << ". Mesh this place anew, with smaller elements or "
                   "without points that nearly coincide.";
        throw InputError(message.str());
      }
      if (volume < 0.)
      {
        std::swap(cell[dim - 1], cell[dim]);
        ++mesh.n_reoriented;
      }
    }
  }

  MeshData<2> curves_of(const MeshData<2> &mesh)
  {
    constexpr unsigned int none = -1;
    MeshData<2> curves;
    curves.group_names = mesh.group_names;
    curves.face_names  = mesh.face_names;
    curves.face_name   = mesh.face_name;
    curves.source      = mesh.source;
    std::vector<unsigned int> number(mesh.vertices.size(), none);
    for (auto line : mesh.faces)
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
      curves.faces.push_back(line);
    }
    return curves;
  }

  template void orient_cells(MeshData<2> &);
  template void orient_cells(MeshData<3> &);
} // namespace quoin
