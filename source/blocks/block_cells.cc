// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/block_cells.h>
#include <quoin/block_elements/tetrahedron.h>
#include <quoin/block_elements/triangle.h>

namespace quoin
{
  namespace
  {
    template <int dim>
    NodeRecord<dim> at_rest(const dealii::Point<dim> &p)
    {
      NodeRecord<dim> record{};
      for (unsigned int d = 0; d < dim; ++d)
        record.X[d] = p[d];
      return record;
    }

    Triangle element(const NodeMap<2> &nodes, const unsigned int cell)
    {
      const auto &[i, j, k] = nodes.cells().nodes[cell];
      return { at_rest(nodes.point(i)), at_rest(nodes.point(j)),
               at_rest(nodes.point(k)) };
    }

    double volume(const Triangle &triangle)
    {
      return triangle.area();
    }
    double volume(const Tetrahedron<OneLane> &tetrahedron)
    {
      return tetrahedron.det / 6.;
    }

    Tetrahedron<OneLane> element(const NodeMap<3> &nodes,
                                 const unsigned int cell)
    {
      const auto &corners = nodes.cells().nodes[cell];
      double edges[3][3];
      for (unsigned int k = 0; k < 3; ++k)
      {
        const auto edge = nodes.point(corners[k + 1]) - nodes.point(corners[0]);
        for (unsigned int d = 0; d < 3; ++d)
          edges[k][d] = edge[d];
      }
      Tetrahedron<OneLane> result;
      result.set_edges(edges);
      return result;
    }
  } // namespace

  template <int dim>
  void take_cells(const NodeMap<dim> &nodes, BlockForcesData<dim> &data)
  {
    const LocalCells<dim> &cells = nodes.cells();
    data.cells.assign(cells.nodes.begin(),
                      cells.nodes.begin() + cells.n_deformable);
    data.block_first_cell = { 0 };
    data.block_first_node = { 0 };
    for (unsigned int b = 0; b < nodes.blocks().n_deformable; ++b)
    {
      const BlockPart &part = nodes.blocks().parts[b];
      // Cells beside other ranks count as a block without nodes of its own, so
      // that they get a tile in a block larger than one tile.
      if (part.cells[0] < part.first_inner_cell
          && part.first_inner_cell < part.cells[1])
      {
        data.block_first_cell.push_back(part.first_inner_cell);
        data.block_first_node.push_back(part.nodes[0]);
      }
      data.block_first_cell.push_back(part.cells[1]);
      data.block_first_node.push_back(part.nodes[1]);
    }
  }

  template <int dim>
  std::vector<double> lumped_masses(const NodeMap<dim> &nodes,
                                    const std::vector<double> &density,
                                    const Thickness &thickness)
  {
    std::vector<dealii::Tensor<1, dim>> mass(nodes.n_local());
    const LocalCells<dim> &cells = nodes.cells();
    for (unsigned int c = 0; c < cells.size(); ++c)
    {
      const double share = volume(element(nodes, c)) * thickness[cells.group[c]]
                           * density[cells.group[c]] / (dim + 1.);
      for (const unsigned int node : cells.mass_nodes(c))
        mass[node][0] += share;
    }
    nodes.exchange().add_to_owners(mass.data());
    nodes.exchange().update_ghosts(mass.data());
    std::vector<double> result;
    for (const dealii::Tensor<1, dim> &m : mass)
      result.push_back(m[0]);
    return result;
  }

  template void take_cells(const NodeMap<2> &, BlockForcesData<2> &);
  template void take_cells(const NodeMap<3> &, BlockForcesData<3> &);
  template std::vector<double> lumped_masses(const NodeMap<2> &,
                                             const std::vector<double> &,
                                             const Thickness &);
  template std::vector<double> lumped_masses(const NodeMap<3> &,
                                             const std::vector<double> &,
                                             const Thickness &);
} // namespace quoin
