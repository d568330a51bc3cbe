// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "random_blocks.h"

#include <quoin/blocks/cell_states.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace quoin;

namespace
{
  using Forces = AlignedArray<dealii::Tensor<1, 2>>;

  Forces strip_forces(const BlockForces<2> &blocks, const RandomBlocks &mesh)
  {
    Forces force(mesh.nodes.size(), dealii::Tensor<1, 2>());
    PlasticHistory none;
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      blocks.add_forces(tile, mesh.nodes.data(), none, force.data());
    return force;
  }

  Forces cell_forces(const BlockForces<2> &blocks, const RandomBlocks &mesh)
  {
    PlasticHistory none;
    Forces force(mesh.nodes.size(), dealii::Tensor<1, 2>());
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      add_forces_by_cell(blocks, tile, mesh.nodes.data(), none, force.data());
    return force;
  }

  Forces viscous_forces(const BlockForces<2> &blocks, const RandomBlocks &mesh,
                        const Forces &velocity, const bool by_cell = false)
  {
    const double beta = 2e-5;
    Forces force(mesh.nodes.size(), dealii::Tensor<1, 2>());
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      if (by_cell)
        add_viscous_forces_by_cell(blocks, tile, mesh.nodes.data(),
                                   velocity.data(), beta, force.data());
      else
        blocks.add_viscous_forces(tile, mesh.nodes.data(), velocity.data(),
                                  beta, force.data());
    return force;
  }

  double power(const Forces &force, const Forces &velocity)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < force.size(); ++i)
      sum += force[i][0] * velocity[i][0] + force[i][1] * velocity[i][1];
    return sum;
  }

  BlockForcesOptions lanes(const unsigned int n)
  {
    BlockForcesOptions options;
    options.n_lanes = n;
    return options;
  }

  const LinearElastic stone{ 2700., 30e9, 0.2 };

  /** Blocks of very different sizes, two materials among them. */
  RandomBlocks assorted_blocks(const PlaneAssumption assumption)
  {
    RandomBlocks mesh(17);
    for (const unsigned int m : { 12u, 1u, 1u, 3u, 25u, 2u, 1u, 7u })
      mesh.add_block(m, 1. + 0.1 * m);
    mesh.add_triangle();
    mesh.add_block(5, 0.3);
    mesh.data.thickness = 0.15;
    mesh.data.stiffness = { plane_stiffness(stone, assumption),
                            plane_stiffness({ 1900., 5e9, 0.33 }, assumption) };
    for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
      mesh.data.cell_stiffness.push_back(k % 7 == 0);
    return mesh;
  }

  const PlaneAssumption both_assumptions[]
      = { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress };
} // namespace

TEST(BlockForces, RigidMotionMakesNoForce)
{
  RandomBlocks mesh     = assorted_blocks(PlaneAssumption::plane_strain);
  BlockForces<2> blocks = mesh.prepared();
  for (const double angle : { 1e-6, 0.3, 1.5707, 3.1415926535897931, -2.5 })
  {
    mesh.move_rigidly(angle, 0.7, -1.3);
    const double scale = stone.young * mesh.data.thickness[0];
    EXPECT_LT(largest(strip_forces(blocks, mesh)), 1e-12 * scale) << angle;
    EXPECT_LT(largest(cell_forces(blocks, mesh)), 1e-12 * scale) << angle;
  }
}

TEST(BlockForces, SmallStrainsKeepTheirDigits)
{
  // Far from the origin, strain 1e-9: positions alone would lose it.
  RandomBlocks mesh(3);
  mesh.add_block(4, 1.);
  for (NodeRecord<2> &node : mesh.nodes)
    node.X[0] += 1e4;
  mesh.data.stiffness
      = { plane_stiffness(stone, PlaneAssumption::plane_stress) };
  for (NodeRecord<2> &node : mesh.nodes)
  {
    node.u[0] = 1e-9 * (node.X[0] - 1e4);
    node.u[1] = -0.2e-9 * node.X[1];
  }
  BlockForces<2> blocks = mesh.prepared();
  std::vector<std::array<double, 4>> stress;
  std::vector<PlaneTensor> strain;
  cell_stresses(blocks, mesh.nodes.data(), {}, stress, strain);
  for (const auto &s : stress)
  {
    EXPECT_NEAR(s[0], 30., 30. * 1e-9);
    EXPECT_NEAR(s[1], 0., 30. * 1e-9);
    EXPECT_NEAR(s[2], 0., 30. * 1e-9);
    EXPECT_EQ(s[3], 0.);
  }
}

TEST(BlockForces, UniformStrainPatch)
{
  for (const PlaneAssumption assumption : both_assumptions)
  {
    RandomBlocks mesh(5);
    mesh.add_block(8, 2.);
    mesh.data.thickness = 0.4;
    mesh.data.stiffness = { plane_stiffness(stone, assumption) };
    // Unit side length 2, corner at the origin.
    const double exx = 2e-6, eyy = -1e-6, exy = 0.7e-6;
    mesh.displace(
        [=](const double x, const double y, dealii::Tensor<1, 2> &u)
        {
          u[0] = exx * x + exy * y;
          u[1] = exy * x + eyy * y;
        });
    BlockForces<2> blocks = mesh.prepared();
    const Forces force    = strip_forces(blocks, mesh);

    const PlaneStiffness &C = mesh.data.stiffness[0];
    const double sxx        = C.c11 * exx + C.c12 * eyy;
    const double syy        = C.c12 * exx + C.c11 * eyy;
    const double sxy        = 2. * C.c33 * exy;
    const double h = 2. / 8., t = mesh.data.thickness[0];
    const double scale = std::abs(sxx) * h * t;
    for (std::size_t i = 0; i < force.size(); ++i)
    {
      // Each boundary node takes half the neighbouring edges' traction; the
      // body pulls its surface inwards.
      const double x = mesh.nodes[i].X[0], y = mesh.nodes[i].X[1];
      const double side_x  = x == 0. ? -1. : (x == 2. ? 1. : 0.);
      const double side_y  = y == 0. ? -1. : (y == 2. ? 1. : 0.);
      const double along_x = h * t * (side_y != 0. && side_x != 0. ? 0.5 : 1.);
      const double fx      = -along_x * (side_x * sxx + side_y * sxy);
      const double fy      = -along_x * (side_x * sxy + side_y * syy);
      // Rotations of the order of the strain: their product remains.
      EXPECT_NEAR(force[i][0], fx, 1e-5 * scale);
      EXPECT_NEAR(force[i][1], fy, 1e-5 * scale);
      if (side_x == 0. && side_y == 0.)
      {
        EXPECT_NEAR(force[i][0], 0., 1e-9 * scale);
        EXPECT_NEAR(force[i][1], 0., 1e-9 * scale);
      }
    }
    std::vector<std::array<double, 4>> stress;
    std::vector<PlaneTensor> strain;
    cell_stresses(blocks, mesh.nodes.data(), {}, stress, strain);
    const double szz = assumption == PlaneAssumption::plane_strain
                           ? stone.poisson * (sxx + syy)
                           : 0.;
    EXPECT_NEAR(stress[0][3], szz, 1e-5 * std::abs(sxx));
    EXPECT_NEAR(strain[0][2], exy, 1e-5 * exy);
  }
}

TEST(BlockForces, PlaneStiffnessIsThatOfUniaxialTests)
{
  // Plane stress: uniaxial tension has modulus E. Plane strain: E/(1-nu^2).
  const double nu = stone.poisson;
  const PlaneStiffness s
      = plane_stiffness(stone, PlaneAssumption::plane_stress);
  EXPECT_NEAR(s.c11 - s.c12 * s.c12 / s.c11, stone.young, 1e-6 * stone.young);
  const PlaneStiffness e
      = plane_stiffness(stone, PlaneAssumption::plane_strain);
  EXPECT_NEAR(e.c11 - e.c12 * e.c12 / e.c11, stone.young / (1. - nu * nu),
              1e-6 * stone.young);
  EXPECT_NEAR(e.c11 - e.c12, 2. * e.c33, 1e-6 * stone.young);
  EXPECT_NEAR(s.c11 - s.c12, 2. * s.c33, 1e-6 * stone.young);
}

TEST(BlockForces, StripsAgreeWithCells)
{
  for (const PlaneAssumption assumption : both_assumptions)
    for (const bool with_stress : { false, true })
      for (const unsigned int n_lanes : { 4u, 8u })
        for (const std::size_t tile_bytes : { 1u, 20000u, 1000000u })
        {
          RandomBlocks mesh = assorted_blocks(assumption);
          if (with_stress)
            mesh.add_initial_stress(1e9);
          mesh.deform(0.05, 2.4);
          BlockForcesOptions options = lanes(n_lanes);
          options.tile_bytes         = tile_bytes;
          options.max_run_cells      = tile_bytes == 1u ? 100 : 10000;
          BlockForces<2> blocks      = mesh.prepared(options);
          const Forces by_strip      = strip_forces(blocks, mesh);
          const Forces by_cell       = cell_forces(blocks, mesh);
          EXPECT_LT(largest_difference(by_strip, by_cell),
                    1e-13 * largest(by_cell));

          double energy = 0.;
          for (std::size_t k = 0; k < mesh.data.cells.size(); ++k)
            energy += cell_energy(mesh.data, mesh.nodes.data(), {}, k);
          EXPECT_NEAR(strain_energy(blocks, mesh.nodes.data(), {}), energy,
                      1e-13 * std::abs(energy));

          const Forces velocity = mesh.random_velocity();
          const Forces viscous  = viscous_forces(blocks, mesh, velocity);
          const Forces viscous_by_cell
              = viscous_forces(blocks, mesh, velocity, true);
          EXPECT_LT(largest_difference(viscous, viscous_by_cell),
                    1e-13 * largest(viscous_by_cell));
        }
}

TEST(BlockForces, ForcesAddToWhatIsThere)
{
  RandomBlocks mesh = assorted_blocks(PlaneAssumption::plane_strain);
  mesh.deform(0.01, 0.2);
  BlockForces<2> blocks = mesh.prepared();
  Forces twice          = strip_forces(blocks, mesh);
  PlasticHistory none;
  for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
    blocks.add_forces(tile, mesh.nodes.data(), none, twice.data());
  Forces once = strip_forces(blocks, mesh);
  for (dealii::Tensor<1, 2> &f : once)
    f = dealii::Point<2>(2. * f[0], 2. * f[1]);
  EXPECT_LT(largest_difference(twice, once), 1e-14 * largest(once));
}

TEST(BlockForces, TilesCoverTheBlocksOnce)
{
  RandomBlocks mesh = assorted_blocks(PlaneAssumption::plane_strain);
  for (const std::size_t tile_bytes : { 1u, 20000u, 1000000u })
  {
    BlockForcesOptions options;
    options.tile_bytes    = tile_bytes;
    BlockForces<2> blocks = mesh.prepared(options);
    std::size_t node = 0, cell = 0;
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
    {
      EXPECT_EQ(blocks.tile_nodes(tile).begin, node);
      EXPECT_EQ(blocks.tile_cells(tile).begin, cell);
      node = blocks.tile_nodes(tile).end;
      cell = blocks.tile_cells(tile).end;
    }
    EXPECT_EQ(node, mesh.nodes.size());
    EXPECT_EQ(cell, mesh.data.cells.size());
  }
}

TEST(BlockForces, NothingToDo)
{
  BlockForcesData<2> data;
  data.block_first_cell = { 0 };
  data.block_first_node = { 0 };
  BlockForces<2> blocks;
  blocks.prepare(data);
  EXPECT_EQ(blocks.n_tiles(), 0u);
  EXPECT_EQ(strain_energy(blocks, nullptr, {}), 0.);
}

TEST(BlockForces, AreMinusTheGradientOfTheEnergy)
{
  for (const bool with_stress : { false, true })
  {
    RandomBlocks mesh(23);
    mesh.add_block(4, 1.);
    mesh.add_block(1, 1.);
    mesh.data.stiffness
        = { plane_stiffness(stone, PlaneAssumption::plane_strain) };
    if (with_stress)
      mesh.add_initial_stress(1e9);
    mesh.deform(0.1, 0.9);
    BlockForces<2> blocks = mesh.prepared();
    const Forces force    = strip_forces(blocks, mesh);
    const double du       = 1e-5;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        double &u         = mesh.nodes[i].u[d];
        const double u0   = u;
        u                 = u0 + du;
        const double up   = strain_energy(blocks, mesh.nodes.data(), {});
        u                 = u0 - du;
        const double down = strain_energy(blocks, mesh.nodes.data(), {});
        u                 = u0;
        EXPECT_NEAR(force[i][d], -(up - down) / (2. * du),
                    2e-7 * largest(force));
      }
  }
}

TEST(BlockForces, ForcesAndMomentsOfEachBlockSumToZero)
{
  for (const bool with_stress : { false, true })
  {
    RandomBlocks mesh = assorted_blocks(PlaneAssumption::plane_stress);
    if (with_stress)
      mesh.add_initial_stress(2e9);
    mesh.deform(0.1, -2.);
    BlockForces<2> blocks = mesh.prepared();
    const Forces force    = strip_forces(blocks, mesh);
    const Forces velocity = mesh.random_velocity();
    const Forces viscous  = viscous_forces(blocks, mesh, velocity);
    for (std::size_t b = 0; b + 1 < mesh.data.block_first_node.size(); ++b)
    {
      double sum[3]         = { 0., 0., 0. };
      double viscous_sum[2] = { 0., 0. };
      for (unsigned int i = mesh.data.block_first_node[b];
           i < mesh.data.block_first_node[b + 1]; ++i)
      {
        const NodeRecord<2> &n = mesh.nodes[i];
        sum[0] += force[i][0];
        sum[1] += force[i][1];
        sum[2] += (n.X[0] + n.u[0]) * force[i][1]
                  - (n.X[1] + n.u[1]) * force[i][0];
        viscous_sum[0] += viscous[i][0];
        viscous_sum[1] += viscous[i][1];
      }
      EXPECT_NEAR(sum[0], 0., 1e-11 * largest(force));
      EXPECT_NEAR(sum[1], 0., 1e-11 * largest(force));
      EXPECT_NEAR(sum[2], 0., 1e-10 * largest(force));
      EXPECT_NEAR(viscous_sum[0], 0., 1e-11 * largest(viscous));
      EXPECT_NEAR(viscous_sum[1], 0., 1e-11 * largest(viscous));
    }
  }
}

TEST(BlockForces, InitialStressTurnsWithTheBlock)
{
  RandomBlocks mesh(4);
  mesh.add_block(5, 1.);
  mesh.data.stiffness
      = { plane_stiffness(stone, PlaneAssumption::plane_strain) };
  mesh.data.initial_stress.assign(mesh.data.cells.size(),
                                  { 3e6, -1e6, 5e5, 4e5 });
  const double angle = 0.6;
  mesh.move_rigidly(angle, 0., 0.);
  BlockForces<2> blocks = mesh.prepared();
  std::vector<std::array<double, 4>> stress;
  std::vector<PlaneTensor> strain;
  cell_stresses(blocks, mesh.nodes.data(), {}, stress, strain);
  const double c = std::cos(angle), s = std::sin(angle);
  for (const auto &sigma : stress)
  {
    EXPECT_NEAR(sigma[0], c * c * 3e6 - s * s * 1e6 - 2. * s * c * 5e5, 1e-2);
    EXPECT_NEAR(sigma[1], s * s * 3e6 - c * c * 1e6 + 2. * s * c * 5e5, 1e-2);
    EXPECT_NEAR(sigma[2], s * c * 4e6 + (c * c - s * s) * 5e5, 1e-2);
    EXPECT_NEAR(sigma[3], 4e5, 1e-2);
  }
}

TEST(BlockForces, ViscousForcesAreLinearAndDissipative)
{
  RandomBlocks mesh = assorted_blocks(PlaneAssumption::plane_strain);
  mesh.deform(0.05, 1.1);
  BlockForces<2> blocks = mesh.prepared();
  const Forces a        = mesh.random_velocity();
  const Forces b        = mesh.random_velocity();
  Forces sum(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
      sum[i][d] = a[i][d] - 3. * b[i][d];
  const Forces fa = viscous_forces(blocks, mesh, a);
  const Forces fb = viscous_forces(blocks, mesh, b);
  const Forces fs = viscous_forces(blocks, mesh, sum);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
      EXPECT_NEAR(fs[i][d], fa[i][d] - 3. * fb[i][d], 1e-12 * largest(fs));
  EXPECT_LT(power(fa, a), 0.);
  EXPECT_LT(power(fb, b), 0.);
}

TEST(BlockForces, ViscousForcesIgnoreRigidMotion)
{
  RandomBlocks mesh = assorted_blocks(PlaneAssumption::plane_strain);
  mesh.move_rigidly(1.2, 0.4, 0.1);
  BlockForces<2> blocks = mesh.prepared();
  Forces velocity(mesh.nodes.size());
  for (std::size_t i = 0; i < velocity.size(); ++i)
  {
    const NodeRecord<2> &n = mesh.nodes[i];
    velocity[i]            = dealii::Point<2>(1. - 7. * (n.X[1] + n.u[1]),
                                   2. + 7. * (n.X[0] + n.u[0]));
  }
  const double scale = 2e-5 * 7. * stone.young * mesh.data.thickness[0];
  EXPECT_LT(largest(viscous_forces(blocks, mesh, velocity)), 1e-11 * scale);
}

TEST(BlockForces, ViscousForcesAreBetaTimesTheForceRate)
{
  // At zero strain the rate of the force is the stiffness times the velocity.
  RandomBlocks mesh(8);
  mesh.add_block(6, 1.);
  mesh.data.stiffness
      = { plane_stiffness(stone, PlaneAssumption::plane_stress) };
  BlockForces<2> blocks = mesh.prepared();
  const Forces velocity = mesh.random_velocity();
  const Forces viscous  = viscous_forces(blocks, mesh, velocity);
  const double dt       = 1e-7;
  const auto at         = [&](const double time)
  {
    RandomBlocks moved = mesh;
    for (std::size_t i = 0; i < velocity.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        moved.nodes[i].u[d] = time * velocity[i][d];
    return strip_forces(blocks, moved);
  };
  const Forces up = at(dt), down = at(-dt);
  for (std::size_t i = 0; i < velocity.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
      EXPECT_NEAR(viscous[i][d], 2e-5 * (up[i][d] - down[i][d]) / (2. * dt),
                  1e-7 * largest(viscous));
}
