// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/block_numbering.h>
#include <quoin/base/none.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace quoin
{
  namespace
  {
    std::vector<unsigned int>
    inverse_permutation(const std::vector<unsigned int> &order)
    {
      std::vector<unsigned int> result(order.size());
      for (unsigned int i = 0; i < order.size(); ++i)
        result[order[i]] = i;
      return result;
    }

    template <typename T>
    std::vector<T> permuted(const std::vector<T> &old,
                            const std::vector<unsigned int> &order)
    {
      std::vector<T> result;
      result.reserve(order.size());
      for (const unsigned int i : order)
        result.push_back(old[i]);
      return result;
    }

    /** New cell i is old cell cell_order[i], and so for vertices. */
    template <int dim>
    void permute(BlockMesh<dim> &mesh,
                 const std::vector<unsigned int> &cell_order,
                 const std::vector<unsigned int> &vertex_order)
    {
      const std::vector<unsigned int> new_cell
          = inverse_permutation(cell_order);
      const std::vector<unsigned int> new_vertex
          = inverse_permutation(vertex_order);

      mesh.vertices   = permuted(mesh.vertices, vertex_order);
      mesh.cells      = permuted(mesh.cells, cell_order);
      mesh.cell_group = permuted(mesh.cell_group, cell_order);
      for (auto &cell : mesh.cells)
        for (unsigned int &v : cell)
          v = new_vertex[v];
      for (BlockFace<dim> &face : mesh.boundary_faces)
      {
        face.cell = new_cell[face.cell];
        for (unsigned int &v : face.vertices)
          v = new_vertex[v];
      }
      for (JointFace<dim> &face : mesh.joint_faces)
      {
        for (unsigned int &c : face.cells)
          c = new_cell[c];
        for (unsigned int k = 0; k < dim; ++k)
        {
          face.lower[k] = new_vertex[face.lower[k]];
          face.upper[k] = new_vertex[face.upper[k]];
        }
      }

      std::sort(mesh.boundary_faces.begin(), mesh.boundary_faces.end(),
                [](const BlockFace<dim> &a, const BlockFace<dim> &b)
                { return a.vertices < b.vertices; });
      std::sort(mesh.joint_faces.begin(), mesh.joint_faces.end(),
                [](const JointFace<dim> &a, const JointFace<dim> &b)
                { return a.lower < b.lower; });
    }

    /**
     * Where along a Hilbert curve through the box of all @p points each of them
     * is (@cite Skilling2004), the same as deal.II's, which takes four times as
     * long.
     */
    template <int dim>
    std::vector<std::uint64_t>
    places_on_curve(const std::vector<dealii::Point<dim>> &points)
    {
      constexpr int n_bits            = dim == 2 ? 31 : 21; // 64 hold them all
      constexpr std::uint64_t largest = (std::uint64_t(1) << n_bits) - 1;
      const auto [low, high]
          = dealii::BoundingBox<dim>(points).get_boundary_points();
      std::vector<std::uint64_t> result;
      result.reserve(points.size());
      for (const dealii::Point<dim> &point : points)
      {
        std::array<std::uint64_t, dim> x{};
        for (unsigned int d = 0; d < dim; ++d)
          if (high[d] > low[d])
          {
            using Long = long double;
            x[d]       = largest
                   * ((Long(point[d]) - low[d]) / (Long(high[d]) - low[d]));
          }
        // 1. The turns of the curve, from large parts to small ones.
        for (int bit = n_bits - 1; bit > 0; --bit)
          for (std::uint64_t &component : x)
          {
            const std::uint64_t below  = (std::uint64_t(1) << bit) - 1;
            const std::uint64_t is_set = -(component >> bit & 1); // all or none
            const std::uint64_t exchanged
                = (x[0] ^ component) & below & ~is_set;
            x[0] ^= exchanged | (below & is_set);
            component ^= exchanged;
          }
        // 2. The Gray code of all bits, one component after the other.
        for (unsigned int d = 1; d < dim; ++d)
          x[d] ^= x[d - 1];
        std::uint64_t above = x[dim - 1] >> 1;
        for (int shift = 1; shift < n_bits; shift *= 2)
          above ^= above >> shift;
        std::uint64_t place = 0;
        for (int bit = n_bits - 1; bit >= 0; --bit)
          for (const std::uint64_t component : x)
            place = place << 1 | ((component ^ above) >> bit & 1);
        result.push_back(place);
      }
      return result;
    }

    /**
     * Cells by block, within a block along a Hilbert curve; the parts of a
     * mixed tetrahedron stay together.
     */
    template <int dim>
    std::vector<unsigned int>
    order_cells(const BlockMesh<dim> &mesh,
                const std::vector<unsigned int> &block_of_cell)
    {
      const unsigned int n      = mesh.n_cells();
      const unsigned int joined = mesh.n_joined_cells();
      std::vector<dealii::Point<dim>> centres(n / joined);
      for (unsigned int i = 0; i < n; ++i)
        for (const unsigned int v : mesh.cells[i])
          centres[i / joined] += mesh.vertices[v];
      for (dealii::Point<dim> &centre : centres)
        centre = centre / ((dim + 1.) * joined);
      const std::vector<std::uint64_t> places = places_on_curve(centres);

      struct Entry
      {
        unsigned int block;
        unsigned int cell;
        std::uint64_t place;
      };
      std::vector<Entry> entries(n);
      for (unsigned int i = 0; i < n; ++i)
        entries[i] = { block_of_cell[i], i, places[i / joined] };
      std::sort(entries.begin(), entries.end(),
                [](const Entry &a, const Entry &b)
                {
                  return std::tie(a.block, a.place, a.cell)
                         < std::tie(b.block, b.place, b.cell);
                });
      std::vector<unsigned int> order;
      order.reserve(n);
      for (const Entry &entry : entries)
        order.push_back(entry.cell);
      return order;
    }

    /**
     * For a vertex on a boundary or joint face the next one counter-clockwise
     * around its block, none for others. It is unique, because a vertex is one
     * fan of cells that hang together by shared edges: at most one face leaves
     * it and one arrives. In three dimensions, where no vertex is the next one,
     * the vertex itself.
     */
    template <int dim>
    std::vector<unsigned int> next_on_boundary(const BlockMesh<dim> &mesh)
    {
      std::vector<unsigned int> next(mesh.n_vertices(), none);
      const auto link = [&](const std::array<unsigned int, dim> &face)
      {
        if constexpr (dim == 2)
          next[face[0]] = face[1];
        else
          for (const unsigned int v : face)
            next[v] = v;
      };
      for (const BlockFace<dim> &face : mesh.boundary_faces)
        link(face.vertices);
      for (const JointFace<dim> &face : mesh.joint_faces)
      {
        link(face.lower);
        auto upper = face.upper;
        std::reverse(upper.begin(), upper.end());
        link(upper);
      }
      return next;
    }
  } // namespace

  template <int dim>
  void number_blocks(BlockMesh<dim> &mesh,
                     const std::vector<unsigned int> &block_of_cell,
                     const unsigned int n_blocks)
  {
    const std::vector<unsigned int> cell_order
        = order_cells(mesh, block_of_cell);
    const std::vector<unsigned int> next = next_on_boundary(mesh);

    mesh.block_first_cell.assign(n_blocks + 1, 0);
    for (const unsigned int b : block_of_cell)
      ++mesh.block_first_cell[b + 1];
    std::partial_sum(mesh.block_first_cell.begin(), mesh.block_first_cell.end(),
                     mesh.block_first_cell.begin());

    mesh.block_first_vertex.assign(1, 0);
    std::vector<unsigned int> vertex_order;
    vertex_order.reserve(mesh.n_vertices());
    std::vector<bool> numbered(mesh.n_vertices(), false);
    const auto number = [&](const unsigned int v)
    {
      vertex_order.push_back(v);
      numbered[v] = true;
    };
    for (unsigned int b = 0; b < n_blocks; ++b)
    {
      const auto for_each_vertex = [&](const auto &function)
      {
        for (unsigned int i = mesh.block_first_cell[b];
             i < mesh.block_first_cell[b + 1]; ++i)
          for (const unsigned int v : mesh.cells[cell_order[i]])
            function(v);
      };
      for_each_vertex(
          [&](const unsigned int first)
          {
            if (next[first] != none)
              for (unsigned int v = first; !numbered[v]; v = next[v])
                number(v);
          });
      for_each_vertex(
          [&](const unsigned int v)
          {
            if (!numbered[v])
              number(v);
          });
      mesh.block_first_vertex.push_back(vertex_order.size());
    }
    permute(mesh, cell_order, vertex_order);
  }

  template <int dim>
  void renumber_blocks(BlockMesh<dim> &mesh,
                       const std::vector<unsigned int> &new_order)
  {
    const unsigned int n_blocks = mesh.n_blocks();
    std::vector<bool> met(n_blocks, false);
    AssertThrow(new_order.size() == n_blocks,
                dealii::ExcDimensionMismatch(new_order.size(), n_blocks));
    for (const unsigned int b : new_order)
    {
      AssertThrow(b < n_blocks && !met[b],
                  dealii::ExcMessage("The order is no permutation."));
      met[b] = true;
    }

    const auto blockwise = [&](std::vector<unsigned int> &first)
    {
      std::vector<unsigned int> order, new_first(1, 0);
      order.reserve(first.back());
      for (const unsigned int b : new_order)
      {
        for (unsigned int i = first[b]; i < first[b + 1]; ++i)
          order.push_back(i);
        new_first.push_back(order.size());
      }
      first = new_first;
      return order;
    };
    const std::vector<unsigned int> cell_order
        = blockwise(mesh.block_first_cell);
    const std::vector<unsigned int> vertex_order
        = blockwise(mesh.block_first_vertex);
    permute(mesh, cell_order, vertex_order);
  }

  std::vector<unsigned int> order_rigid_last(const std::vector<bool> &is_rigid)
  {
    std::vector<unsigned int> order(is_rigid.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_partition(order.begin(), order.end(),
                          [&](const unsigned int b) { return !is_rigid[b]; });
    return order;
  }

  template void number_blocks(BlockMesh<2> &, const std::vector<unsigned int> &,
                              unsigned int);
  template void number_blocks(BlockMesh<3> &, const std::vector<unsigned int> &,
                              unsigned int);
  template void renumber_blocks(BlockMesh<2> &,
                                const std::vector<unsigned int> &);
  template void renumber_blocks(BlockMesh<3> &,
                                const std::vector<unsigned int> &);
} // namespace quoin
