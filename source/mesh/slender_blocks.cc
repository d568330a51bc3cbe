// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/slender_blocks.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Thickness by length from which a block is not slender [-]. */
    constexpr double slender = 0.25;
    /** Cells across from which bending is nearly right; meshes of four layers
        have four, but for rounding. */
    constexpr double enough = 3.9;
    /** Cosine between the normal of a face and the thickness that it bounds,
        at least. */
    constexpr double along = 0.7;

    template <int dim>
    dealii::Point<3> in_three(const dealii::Tensor<1, dim> &p)
    {
      dealii::Point<3> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = p[d];
      return result;
    }

    /** Normal of a face, times its size. */
    dealii::Tensor<1, 2> normal_of(const BlockMesh<2> &mesh,
                                   const std::array<unsigned int, 2> &face)
    {
      const auto edge = mesh.vertices[face[1]] - mesh.vertices[face[0]];
      return dealii::Point<2>(edge[1], -edge[0]);
    }
    dealii::Tensor<1, 3> normal_of(const BlockMesh<3> &mesh,
                                   const std::array<unsigned int, 3> &face)
    {
      const auto &p = mesh.vertices[face[0]];
      return 0.5
             * dealii::cross_product_3d(mesh.vertices[face[1]] - p,
                                        mesh.vertices[face[2]] - p);
    }

    /** The extents of a box of the same moments of inertia as a block, and
        their directions. */
    template <int dim>
    struct Extents
    {
      dealii::Point<dim> middle;
      std::array<std::pair<double, dealii::Tensor<1, dim>>, dim> all;
    };

    template <int dim>
    Extents<dim> extents_of(const BlockMesh<dim> &mesh,
                            const unsigned int block)
    {
      // Counted from a vertex, so that few digits are lost far from the origin.
      const unsigned int first         = mesh.block_first_cell[block];
      const unsigned int end           = mesh.block_first_cell[block + 1];
      const dealii::Point<dim> &origin = mesh.vertices[mesh.cells[first][0]];
      double volume                    = 0.;
      dealii::Tensor<1, dim> moment;
      dealii::SymmetricTensor<2, dim> second;
      for (unsigned int c = first; c < end; ++c)
      {
        dealii::Tensor<2, dim> edges;
        dealii::Tensor<1, dim> sum;
        dealii::SymmetricTensor<2, dim> squares;
        for (unsigned int k = 0; k <= dim; ++k)
        {
          const dealii::Tensor<1, dim> x
              = mesh.vertices[mesh.cells[c][k]] - origin;
          if (k > 0)
            edges[k - 1] = mesh.vertices[mesh.cells[c][k]]
                           - mesh.vertices[mesh.cells[c][0]];
          sum += x;
          squares += dealii::symmetrize(dealii::outer_product(x, x));
        }
        const double size = dealii::determinant(edges) / (dim == 2 ? 2. : 6.);
        volume += size;
        moment += size / (dim + 1.) * sum;
        second += size / ((dim + 1.) * (dim + 2.))
                  * (squares
                     + dealii::symmetrize(dealii::outer_product(sum, sum)));
      }
      Extents<dim> result;
      const dealii::Tensor<1, dim> middle = moment / volume;
      result.middle                       = origin + middle;
      second /= volume;
      second -= dealii::symmetrize(dealii::outer_product(middle, middle));
      result.all = dealii::eigenvectors(second);
      for (auto &[square, direction] : result.all)
        square = std::sqrt(12. * std::max(0., square));
      return result;
    }

    /** Mean extent of the cells of @p block along @p axis [m]. */
    template <int dim>
    double mean_extent(const BlockMesh<dim> &mesh, const unsigned int block,
                       const dealii::Tensor<1, dim> &axis)
    {
      const unsigned int first = mesh.block_first_cell[block];
      const unsigned int end   = mesh.block_first_cell[block + 1];
      double sum               = 0.;
      for (unsigned int c = first; c < end; ++c)
      {
        double low = axis * mesh.vertices[mesh.cells[c][0]], high = low;
        for (const unsigned int vertex : mesh.cells[c])
        {
          const double height = axis * mesh.vertices[vertex];
          low                 = std::min(low, height);
          high                = std::max(high, height);
        }
        sum += high - low;
      }
      return sum / (end - first);
    }
  } // namespace

  double SlenderBlock::lost_deflection(const unsigned int dimension) const
  {
    const double lost = dimension == 2 ? 2.6 : 5.;
    return lost / (n_across * n_across + lost);
  }

  template <int dim>
  std::vector<SlenderBlock> slender_blocks(const BlockMesh<dim> &mesh)
  {
    std::vector<SlenderBlock> result;
    if (mesh.quadratic || mesh.mixed)
      return result;
    std::map<unsigned int, unsigned int> found; // places of blocks in 'result'
    for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
    {
      const Extents<dim> extents = extents_of(mesh, b);
      const auto least
          = *std::min_element(extents.all.begin(), extents.all.end(),
                              [](const auto &a, const auto &b)
                              { return a.first < b.first; }),
          most = *std::max_element(extents.all.begin(), extents.all.end(),
                                   [](const auto &a, const auto &b)
                                   { return a.first < b.first; });
      SlenderBlock block;
      block.thickness = least.first;
      block.length    = most.first;
      if (!(block.thickness < slender * block.length))
        continue;
      block.n_across = block.thickness / mean_extent(mesh, b, least.second);
      if (block.n_across >= enough)
        continue;
      block.group  = mesh.cell_group[mesh.block_first_cell[b]];
      block.axis   = in_three(least.second);
      block.middle = in_three<dim>(extents.middle);
      found[b]     = result.size();
      result.push_back(block);
    }
    if (found.empty())
      return result;
    // Sizes of faces; 'name' of an outer one.
    const auto add = [&](const std::array<unsigned int, dim> &face,
                         const unsigned int cell, const std::string *name)
    {
      const auto place = found.find(mesh.block_of_cell(cell));
      if (place == found.end())
        return;
      SlenderBlock &block = result[place->second];
      const auto normal   = normal_of(mesh, face);
      const double size   = normal.norm();
      if (std::abs(in_three(normal) * block.axis) < along * size)
        return;
      block.faces += size;
      if (name)
        block.outer[*name] += size;
    };
    for (const BlockFace<dim> &face : mesh.boundary_faces)
      add(face.vertices, face.cell, &mesh.face_names[face.name]);
    for (const JointFace<dim> &face : mesh.joint_faces)
    {
      add(face.lower, face.cells[0], nullptr);
      add(face.upper, face.cells[1], nullptr);
    }
    return result;
  }

  template std::vector<SlenderBlock> slender_blocks(const BlockMesh<2> &);
  template std::vector<SlenderBlock> slender_blocks(const BlockMesh<3> &);
} // namespace quoin
