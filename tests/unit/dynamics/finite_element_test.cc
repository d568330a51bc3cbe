// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// The block kernel against deal.II's own linear simplex elements.

#include <quoin/blocks/block_forces.h>
#include <quoin/mesh/block_mesh.h>
#include <quoin/mesh/block_splitter.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <cmath>

namespace quoin
{
  namespace
  {
    /** A square of 2 n^2 triangles with shifted inner nodes. */
    MeshData<2> square(const unsigned int n)
    {
      MeshData<2> data;
      data.source = "square";
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
        {
          const bool inner = i > 0 && i < n && j > 0 && j < n;
          const double dx  = inner ? 0.2 * std::sin(3. * i + 5. * j) : 0.;
          const double dy  = inner ? 0.2 * std::cos(4. * i + 3. * j) : 0.;
          data.vertices.emplace_back((i + dx) / n, (j + dy) / n);
        }
      data.group_names = { "rock" };
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = j * (n + 1) + i, b = a + 1, c = a + n + 2,
                             d = a + n + 1;
          data.cells.push_back({ a, b, c });
          data.cells.push_back({ a, c, d });
          data.cell_group.insert(data.cell_group.end(), 2, 0);
        }
      return data;
    }
  } // namespace

  TEST(FiniteElement, SameForcesAsLinearSimplexElementsOfTheLibrary)
  {
    BlockMesh<2> mesh = split_into_blocks(square(5), SplitOptions());
    std::vector<dealii::CellData<2>> triangles(mesh.n_cells(),
                                               dealii::CellData<2>(3));
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      triangles[c].vertices.assign(mesh.cells[c].begin(), mesh.cells[c].end());
    dealii::Triangulation<2> triangulation;
    triangulation.create_triangulation(mesh.vertices, triangles,
                                       dealii::SubCellData());

    const LinearElastic rock{ 2500., 3e10, 0.3 };
    const auto stiffness = plane_stiffness(rock, PlaneAssumption::plane_strain);
    BlockForcesData<2> data;
    data.cells            = mesh.cells;
    data.block_first_cell = mesh.block_first_cell;
    data.block_first_node = mesh.block_first_vertex;
    data.stiffness        = { stiffness };
    data.thickness        = 0.5;
    BlockForces<2> blocks;
    blocks.prepare(data);

    // Displacements small enough for the rotation not to matter.
    AlignedArray<NodeRecord<2>> nodes;
    for (const auto &p : mesh.vertices)
      nodes.push_back(
          { p, dealii::Point<2>(1e-12 * std::sin(7. * p[0] + 3. * p[1]),
                                1e-12 * std::cos(5. * p[0] - 4. * p[1])) });
    AlignedArray<dealii::Tensor<1, 2>> force(nodes.size(),
                                             dealii::Tensor<1, 2>());
    PlasticHistory none;
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      blocks.add_forces(tile, nodes.data(), none, force.data());

    // - integral of B^T C B u with Lame's constants of plane strain.
    const dealii::FESystem<2> element(dealii::FE_SimplexP<2>(1), 2);
    const dealii::MappingFE<2> mapping(dealii::FE_SimplexP<2>(1));
    dealii::DoFHandler<2> dofs(triangulation);
    dofs.distribute_dofs(element);
    dealii::FEValues<2> values(mapping, element, dealii::QGaussSimplex<2>(1),
                               dealii::update_gradients
                                   | dealii::update_JxW_values);
    const dealii::FEValuesExtractors::Vector displacement(0);
    const double mu     = 3e10 / 2.6;
    const double lambda = 3e10 * 0.3 / (1.3 * 0.4);
    std::vector<dealii::Tensor<1, 2>> expected(nodes.size(),
                                               dealii::Tensor<1, 2>());
    double largest = 0.;
    for (const auto &cell : dofs.active_cell_iterators())
    {
      values.reinit(cell);
      dealii::SymmetricTensor<2, 2> strain;
      for (unsigned int i = 0; i < element.dofs_per_cell; ++i)
      {
        const auto [component, k] = element.system_to_component_index(i);
        strain += nodes[cell->vertex_index(k)].u[component]
                  * values[displacement].symmetric_gradient(i, 0);
      }
      const auto stress
          = lambda * trace(strain) * dealii::unit_symmetric_tensor<2>()
            + 2. * mu * strain;
      for (unsigned int i = 0; i < element.dofs_per_cell; ++i)
      {
        const auto [component, k] = element.system_to_component_index(i);
        expected[cell->vertex_index(k)][component]
            -= 0.5 * values.JxW(0)
               * (stress * values[displacement].symmetric_gradient(i, 0));
      }
    }
    for (const dealii::Tensor<1, 2> &f : expected)
      largest = std::max({ largest, std::abs(f[0]), std::abs(f[1]) });
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        EXPECT_NEAR(force[i][d], expected[i][d], 1e-9 * largest);
  }
} // namespace quoin
