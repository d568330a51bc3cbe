// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../blocks/random_blocks.h"

#include <quoin/block_elements/triangle.h>
#include <quoin/blocks/cell_states.h>

#include <deal.II/base/array_view.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace quoin;

namespace
{
  const LinearElastic stone{ 2700., 30e9, 0.2 };

  /**
   * Largest eigenvalue of M^-1 K at zero strain: power iteration with the
   * forces of small displacements.
   */
  double power_iteration(const RandomBlocks &mesh)
  {
    BlockForces<2> blocks = mesh.prepared();
    std::vector<double> mass(mesh.nodes.size(), 0.);
    for (const auto &[a, b, c] : mesh.data.cells)
    {
      const Triangle triangle(mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]);
      for (const unsigned int node : { a, b, c })
        mass[node]
            += stone.density * triangle.area() * mesh.data.thickness[0] / 3.;
    }
    RandomBlocks x = mesh;
    for (NodeRecord<2> &node : x.nodes)
      for (double &u : dealii::make_array_view(node.u))
        u = 1e-9 * x.random();
    double eigenvalue = 0.;
    for (unsigned int k = 0; k < 3000; ++k)
    {
      AlignedArray<dealii::Tensor<1, 2>> force(mesh.nodes.size(),
                                               dealii::Tensor<1, 2>());
      PlasticHistory none;
      for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
        add_forces_by_cell(blocks, tile, x.nodes.data(), none, force.data());
      double before = 0., after = 0.;
      for (std::size_t i = 0; i < force.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
        {
          double &u = x.nodes[i].u[d];
          before += u * u;
          u = -force[i][d] / mass[i];
          after += u * u;
        }
      eigenvalue = std::sqrt(after / before);
      for (NodeRecord<2> &node : x.nodes)
        for (double &u : dealii::make_array_view(node.u))
          u *= 1e-9 / std::sqrt(after);
    }
    return eigenvalue;
  }

  double largest_of_cells(const RandomBlocks &mesh)
  {
    double max = 0.;
    for (const auto &[a, b, c] : mesh.data.cells)
      max = std::max(max,
                     largest_eigenvalue_squared_frequency(
                         Triangle(mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]),
                         mesh.data.stiffness[0], stone.density));
    return max;
  }
} // namespace

TEST(Triangle, FrequencyIsExactForOneElement)
{
  for (const PlaneAssumption assumption :
       { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress })
  {
    RandomBlocks mesh(1);
    mesh.add_triangle();
    mesh.data.thickness = 0.3;
    mesh.data.stiffness = { plane_stiffness(stone, assumption) };
    const double exact  = power_iteration(mesh);
    EXPECT_NEAR(largest_of_cells(mesh), exact, 1e-7 * exact);
  }
}

TEST(Triangle, FrequencyBoundsThatOfTheMesh)
{
  for (const unsigned int seed : { 1u, 2u, 3u })
  {
    RandomBlocks mesh(seed);
    mesh.add_block(6, 1.);
    mesh.data.stiffness
        = { plane_stiffness(stone, PlaneAssumption::plane_strain) };
    const double of_mesh  = power_iteration(mesh);
    const double of_cells = largest_of_cells(mesh);
    EXPECT_GE(of_cells, of_mesh);
  }
}

TEST(Triangle, StrainIsThatOfTheStretchAtAnyAngle)
{
  for (const double angle : { 0., 0.1, 2., 3.14159265358979, -1.6 })
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const PlaneTensor e{ 0.02, -0.05, 0.03 };
    const double U[4] = { 1. + e[0], e[2], e[2], 1. + e[1] };
    const CorotatedStrain strain({ c * U[0] - s * U[2] - 1.,
                                   c * U[1] - s * U[3], s * U[0] + c * U[2],
                                   s * U[1] + c * U[3] - 1. });
    EXPECT_NEAR(strain.c, c, 1e-15);
    EXPECT_NEAR(strain.s, s, 1e-15);
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(strain.e[i], e[i], 1e-15);
  }
}

TEST(Triangle, TinyStrainsOfTurnedTrianglesKeepSevenDigits)
{
  const double e = 1e-9, angle = 0.7;
  const double h  = std::sin(0.5 * angle);
  const double c1 = -2. * h * h, s = std::sin(angle), c = 1. + c1;
  const CorotatedStrain strain(
      { c1 + c * e, -s, s + s * e, c1 }); // R (I + diag(e, 0)) - I
  EXPECT_NEAR(strain.e[0], e, 2e-7 * e);
  EXPECT_NEAR(strain.e[1], 0., 2e-7 * e);
  EXPECT_NEAR(strain.e[2], 0., 2e-7 * e);
}
