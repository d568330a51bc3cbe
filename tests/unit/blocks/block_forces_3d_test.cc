// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "tetrahedron_blocks.h"

#include <quoin/block_elements/cell_tangent.h>
#include <quoin/blocks/cell_states.h>

#include <deal.II/base/array_view.h>

#include <gtest/gtest.h>

#include <numeric>

using namespace quoin;
using namespace quoin::test;

namespace
{
  const LinearElastic stone{ 2700., 30e9, 0.2 };
  const LinearElastic brick{ 1900., 5e9, 0.33 };

  /** Blocks of very different sizes, two materials among them. */
  TetrahedronBlocks assorted_blocks()
  {
    TetrahedronBlocks mesh;
    mesh.add_box({ 7, 6, 5 }, { 1., 0.9, 1.1 }, { 0., 0., 0. }, 0.2);
    mesh.add_box({ 1, 1, 1 }, { 0.3, 0.2, 0.1 }, { 2., 0., 0. });
    mesh.add_box({ 2, 1, 3 }, { 0.3, 0.2, 0.1 }, { 2., 1., 0. });
    mesh.add_box({ 12, 3, 2 }, { 2., 0.7, 0.4 }, { 0., 2., 0. }, 0.2);
    mesh.data.stiffness = { space_stiffness(stone), space_stiffness(brick) };
    for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
      mesh.data.cell_stiffness.push_back(k % 7 == 0);
    return mesh;
  }

  double power(const Forces3 &force, const Forces3 &velocity)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < force.size(); ++i)
      sum += vector(force[i]).dot(vector(velocity[i]));
    return sum;
  }

  Forces3 random_velocity(TetrahedronBlocks &mesh)
  {
    Forces3 velocity = mesh.zero();
    for (dealii::Tensor<1, 3> &v : velocity)
      for (double &component : dealii::make_array_view(v))
        component = mesh.uniform(1.);
    return velocity;
  }

  Forces3 viscous_forces(const BlockForces<3> &blocks,
                         const TetrahedronBlocks &mesh, const Forces3 &velocity,
                         const double beta)
  {
    Forces3 force = mesh.zero();
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      blocks.add_viscous_forces(tile, mesh.nodes.data(), velocity.data(), beta,
                                force.data());
    return force;
  }

  /** Sum of the forces on nodes [begin, end) and their moment. */
  std::pair<Vector3d, Vector3d> resultants(const TetrahedronBlocks &mesh,
                                           const Forces3 &force,
                                           const unsigned int begin,
                                           const unsigned int end)
  {
    Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
    for (unsigned int i = begin; i < end; ++i)
    {
      const Vector3d x = vector(mesh.nodes[i].X) + vector(mesh.nodes[i].u);
      sum += vector(force[i]);
      moment += x.cross(vector(force[i]));
    }
    return { sum, moment };
  }
} // namespace

TEST(BlockForces3, RigidMotionMakesNoForce)
{
  TetrahedronBlocks mesh = assorted_blocks();
  BlockForces<3> blocks  = mesh.prepared();
  for (const double angle : { 1e-6, 0.3, 1.5707, 3.1415926535897931, -2.5 })
  {
    mesh.displace(rotation(angle, { 1., -2., 0.5 }), { 0.7, -1.3, 4. });
    EXPECT_LT(largest(mesh.forces(blocks)), 1e-12 * stone.young) << angle;
    EXPECT_LT(largest(mesh.forces(blocks, true)), 1e-12 * stone.young);
  }
}

TEST(BlockForces3, SmallStrainsKeepTheirDigits)
{
  // Far from the origin, strain 1e-9: positions alone would lose it.
  TetrahedronBlocks mesh;
  mesh.add_box({ 3, 3, 3 }, { 1., 1., 1. }, { 8192., 0., 0. });
  mesh.data.stiffness = { space_stiffness(stone) };
  for (NodeRecord<3> &node : mesh.nodes)
  {
    node.u[0] = 1e-9 * (node.X[0] - 8192.);
    node.u[1] = -0.2e-9 * node.X[1];
    node.u[2] = -0.2e-9 * node.X[2];
  }
  BlockForces<3> blocks = mesh.prepared();
  for (unsigned int k = 0; k < blocks.cell_data().cells.size(); ++k)
  {
    const SpaceTensor s = cell_stress(blocks, mesh.nodes.data(), {}, k);
    EXPECT_NEAR(s[0], 30., 30. * 1e-8);
    for (unsigned int i = 1; i < 6; ++i)
      EXPECT_NEAR(s[i], 0., 30. * 1e-8);
  }
}

TEST(BlockForces3, UniformStrainPatch)
{
  // Any strain, turned by any angle: exact in every cell, no force inside.
  for (const double angle : { 0., 1e-3, 1.2, 3. })
    for (const double size : { 1e-6, 0.05 })
    {
      TetrahedronBlocks mesh;
      mesh.add_box({ 5, 4, 3 }, { 2., 1.5, 1. }, Vector3d::Zero(), 0.3);
      mesh.data.stiffness   = { space_stiffness(stone) };
      BlockForces<3> blocks = mesh.prepared();
      Matrix3d e;
      e << 1., 0.4, -0.3, 0.4, -0.5, 0.2, -0.3, 0.2, 0.7;
      e *= size;
      const Matrix3d I = Matrix3d::Identity();
      const Matrix3d R = rotation(angle, { 0.3, 1., -0.4 });
      mesh.displace(R * (I + e), { 1., 2., 3. });

      const SpaceStiffness C = mesh.data.stiffness[0];
      const Matrix3d S       = C.lambda * e.trace() * I + 2. * C.mu * e;
      const Matrix3d sigma   = R * S * R.transpose();
      const double tolerance = 1e-13 * stone.young;
      std::vector<SpaceTensor> stress, strain;
      cell_stresses(blocks, mesh.nodes.data(), {}, stress, strain);
      for (unsigned int k = 0; k < blocks.cell_data().cells.size(); ++k)
      {
        EXPECT_LT((matrix(stress[k]) - sigma).cwiseAbs().maxCoeff(), tolerance);
        EXPECT_LT(
            (matrix(strain[k]) - R * e * R.transpose()).cwiseAbs().maxCoeff(),
            1e-13);
      }

      const Forces3 force    = mesh.forces(blocks);
      const double extent[3] = { 2., 1.5, 1. };
      Matrix3d moments       = Matrix3d::Zero();
      for (unsigned int i = 0; i < force.size(); ++i)
      {
        bool inside = true;
        for (unsigned int d = 0; d < 3; ++d)
          inside = inside && mesh.nodes[i].X[d] > 0.
                   && mesh.nodes[i].X[d] < extent[d];
        if (inside)
        {
          EXPECT_LT(vector(force[i]).norm(), tolerance);
        }
        moments += vector(force[i]) * vector(mesh.nodes[i].X).transpose();
      }
      // The mean of the first Piola-Kirchhoff stress, times the volume.
      EXPECT_LT((moments + 3. * R * S).cwiseAbs().maxCoeff(), 10. * tolerance);
    }
}

TEST(BlockForces3, LanesAgreeWithCells)
{
  for (const double size : { 1e-5, 0.03 })
    for (const double angle : { 0., 1.9 })
      for (const bool with_stress : { false, true })
        for (const unsigned int n_lanes : { 4u, 8u })
          for (const std::size_t tile_bytes : { 1u, 20000u, 1000000u })
          {
            TetrahedronBlocks mesh = assorted_blocks();
            if (with_stress)
              mesh.add_initial_stress(1e8);
            mesh.displace(rotation(angle, { 1., 1., -0.3 }));
            mesh.disturb(0.05 * size);
            BlockForcesOptions options;
            options.n_lanes       = n_lanes;
            options.tile_bytes    = tile_bytes;
            options.max_run_cells = tile_bytes == 1u ? 37 : 4096;
            BlockForces<3> blocks = mesh.prepared(options);
            const Forces3 by_lane = mesh.forces(blocks);
            const Forces3 by_cell = mesh.forces(blocks, true);
            // Both lose to a rotation what its digits are worth, each in its
            // own way, since in a pair edges start at another node: an eps of
            // strain times the area of a face, 0.02 m^2, in some twenty cells
            // around a node.
            const double rounding = 1e-14 * largest(by_cell)
                                    + (angle > 0. ? 6e-17 * stone.young : 0.);
            EXPECT_LT(largest_difference(by_lane, by_cell), rounding)
                << size << ' ' << angle << ' ' << largest(by_cell);
            expect_energy_of_cells(blocks, mesh, size);
          }
}

TEST(BlockForces3, TilesCoverTheBlocksOnce)
{
  TetrahedronBlocks mesh = assorted_blocks();
  for (const std::size_t tile_bytes : { 1u, 10000u, 100000000u })
  {
    BlockForcesOptions options;
    options.tile_bytes    = tile_bytes;
    BlockForces<3> blocks = mesh.prepared(options);
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
    EXPECT_EQ(blocks.n_tiles(), tile_bytes == 1u ? 4u : blocks.n_tiles());
  }
}

TEST(BlockForces3, NothingToDo)
{
  BlockForcesData<3> data;
  data.block_first_cell = { 0 };
  data.block_first_node = { 0 };
  BlockForces<3> blocks;
  blocks.prepare(data);
  EXPECT_EQ(blocks.n_tiles(), 0u);
  EXPECT_EQ(blocks.cell_data().cells.size(), 0u);
}

TEST(BlockForces3, CellsMayHaveNodesBehindThoseOfAllBlocks)
{
  // A block in two halves, as on two ranks: the nodes of the cut come last
  // and belong to no tile.
  TetrahedronBlocks whole;
  whole.add_box({ 6, 3, 3 }, { 2., 1., 1. }, Vector3d::Zero(), 0.2);
  whole.data.stiffness = { space_stiffness(stone) };
  whole.displace(rotation(0.4, { 1., 2., 3. }));
  whole.disturb(1e-3);
  BlockForces<3> blocks  = whole.prepared();
  const Forces3 expected = whole.forces(blocks);

  TetrahedronBlocks cut;
  std::vector<unsigned int> order(whole.nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto part = [&](const unsigned int i)
  {
    const double x = std::round(3. * whole.nodes[i].X[0]);
    return x < 3. ? 0 : (x > 3. ? 1 : 2);
  };
  const auto cell_part = [&](const std::array<unsigned int, 4> &cell)
  {
    for (const unsigned int i : cell)
      if (part(i) != 2)
        return part(i);
    return 0;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const unsigned int a, const unsigned int b)
                   { return part(a) < part(b); });
  std::vector<unsigned int> number(order.size());
  for (unsigned int k = 0; k < order.size(); ++k)
  {
    number[order[k]] = k;
    cut.nodes.push_back(whole.nodes[order[k]]);
  }
  for (int p = 0; p < 2; ++p)
  {
    for (auto cell : whole.data.cells)
      if (cell_part(cell) == p)
      {
        for (unsigned int &i : cell)
          i = number[i];
        cut.data.cells.push_back(cell);
      }
    cut.data.block_first_cell.push_back(cut.data.cells.size());
    cut.data.block_first_node.push_back(
        std::count_if(order.begin(), order.end(),
                      [&](const unsigned int i) { return part(i) <= p; }));
  }
  cut.data.stiffness = whole.data.stiffness;
  ASSERT_EQ(cut.data.cells.size(), whole.data.cells.size());
  ASSERT_LT(cut.data.block_first_node.back(), cut.nodes.size());
  BlockForcesOptions options;
  options.tile_bytes = 1;
  blocks.prepare(cut.data, options);
  const Forces3 force = cut.forces(blocks);
  for (unsigned int i = 0; i < number.size(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(force[number[i]][d], expected[i][d],
                  1e-13 * largest(expected));
}

TEST(BlockForces3, AreMinusTheGradientOfTheEnergy)
{
  for (const bool with_stress : { false, true })
  {
    TetrahedronBlocks mesh;
    mesh.add_box({ 2, 1, 2 }, { 1., 0.8, 1.2 });
    mesh.data.stiffness = { space_stiffness(stone) };
    if (with_stress)
      mesh.add_initial_stress(3e9);
    BlockForces<3> blocks = mesh.prepared();
    mesh.displace(rotation(2.1, { 0.2, 1., 1. }));
    mesh.disturb(0.05);
    const Forces3 force = mesh.forces(blocks);
    const double h      = 1e-5;
    for (unsigned int i = 0; i < force.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
      {
        double &u           = mesh.nodes[i].u[d];
        const double before = u;
        const auto energy   = [&](const double at)
        {
          u = before + at;
          return strain_energy(blocks, mesh.nodes.data(), {});
        };
        const double slope = (8. * (energy(h) - energy(-h))
                              - (energy(2. * h) - energy(-2. * h)))
                             / (12. * h);
        u = before;
        EXPECT_NEAR(force[i][d], -slope, 1e-9 * largest(force));
      }
  }
}

TEST(BlockForces3, ForcesAndMomentsOfEachBlockSumToZero)
{
  for (const bool with_stress : { false, true })
  {
    TetrahedronBlocks mesh = assorted_blocks();
    if (with_stress)
      mesh.add_initial_stress(1e9);
    mesh.displace(rotation(2.7, { 0.2, 1., 1. }));
    mesh.disturb(0.003);
    BlockForces<3> blocks = mesh.prepared();
    const Forces3 force   = mesh.forces(blocks);
    const Forces3 viscous
        = viscous_forces(blocks, mesh, random_velocity(mesh), 1e-4);
    for (unsigned int b = 0; b + 1 < mesh.data.block_first_node.size(); ++b)
      for (const Forces3 *f : { &force, &viscous })
      {
        const auto [sum, moment]
            = resultants(mesh, *f, mesh.data.block_first_node[b],
                         mesh.data.block_first_node[b + 1]);
        EXPECT_LT(sum.norm(), 1e-12 * largest(*f));
        EXPECT_LT(moment.norm(), 1e-12 * largest(*f));
      }
  }
}

TEST(BlockForces3, InitialStressTurnsWithTheBlock)
{
  TetrahedronBlocks mesh;
  mesh.add_box({ 3, 3, 3 }, { 1., 1., 1. }, Vector3d::Zero(), 0.2);
  mesh.data.stiffness = { space_stiffness(stone) };
  Matrix3d s;
  s << -3e6, 1e6, 0.5e6, 1e6, -1e6, 0.2e6, 0.5e6, 0.2e6, -2e6;
  for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
    mesh.data.initial_stress.push_back(components(s));
  BlockForces<3> blocks = mesh.prepared();
  const Forces3 before  = mesh.forces(blocks);
  const Matrix3d R      = rotation(1.3, { 1., 1., 0.3 });
  mesh.displace(R);
  const Forces3 after = mesh.forces(blocks);
  for (unsigned int i = 0; i < after.size(); ++i)
    EXPECT_LT((vector(after[i]) - R * vector(before[i])).norm(),
              1e-4); // of 1e5 N
  EXPECT_LT((matrix(cell_stress(blocks, mesh.nodes.data(), {}, 17))
             - R * s * R.transpose())
                .norm(),
            1e-3);
}

TEST(BlockForces3, ViscousForces)
{
  TetrahedronBlocks mesh = assorted_blocks();
  mesh.displace(rotation(1.7, { 0.2, -1., 1. }));
  mesh.disturb(0.002);
  BlockForces<3> blocks  = mesh.prepared();
  const double beta      = 2e-5;
  const Forces3 velocity = random_velocity(mesh);
  const Forces3 force    = viscous_forces(blocks, mesh, velocity, beta);
  EXPECT_LT(power(force, velocity), 0.);

  // Rigid motion of the deformed blocks makes none.
  Forces3 rigid = mesh.zero();
  for (unsigned int i = 0; i < rigid.size(); ++i)
  {
    const Vector3d x = vector(mesh.nodes[i].X) + vector(mesh.nodes[i].u);
    const Vector3d v
        = Vector3d(0.3, -1., 0.4) + Vector3d(1., 0.2, -0.5).cross(x);
    std::copy(v.data(), v.data() + 3, rigid[i].begin_raw());
  }
  EXPECT_LT(largest(viscous_forces(blocks, mesh, rigid, beta)),
            1e-12 * largest(force));

  // At rest they are beta times the rate of the elastic forces.
  const double h = 1e-7;
  mesh.displace(Matrix3d::Identity());
  const Forces3 at_rest = viscous_forces(blocks, mesh, velocity, beta);
  for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
      mesh.nodes[i].u[d] = h * velocity[i][d];
  Forces3 rate = mesh.forces(blocks);
  for (dealii::Tensor<1, 3> &f : rate)
    for (double &component : dealii::make_array_view(f))
      component *= beta / h;
  EXPECT_LT(largest_difference(at_rest, rate), 1e-5 * largest(at_rest));
}

TEST(BlockForces3, StiffnessIsTheDerivativeOfTheForces)
{
  for (const bool with_stress : { false, true })
  {
    TetrahedronBlocks mesh;
    mesh.add_box({ 1, 1, 1 }, { 1., 0.8, 1.2 });
    mesh.data.stiffness = { space_stiffness(stone) };
    if (with_stress)
      mesh.add_initial_stress(5e9);
    BlockForces<3> blocks = mesh.prepared();
    mesh.displace(rotation(0.8, { 0.2, 1., 1. }));
    mesh.disturb(0.05);
    const unsigned int n = 3 * mesh.nodes.size();
    Eigen::MatrixXd K    = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd sum  = Eigen::VectorXd::Zero(n);
    PlasticHistory none;
    for (unsigned int k = 0; k < blocks.cell_data().cells.size(); ++k)
    {
      CellLinearisation cell;
      ASSERT_TRUE(
          linearise_cell(blocks.cell_data(), k, mesh.nodes.data(), none, cell));
      ASSERT_EQ(cell.n_nodes, 4u);
      for (unsigned int i = 0; i < 12; ++i)
      {
        const unsigned int row = 3 * cell.nodes[i / 3] + i % 3;
        sum[row] += cell.force[i];
        for (unsigned int j = 0; j < 12; ++j)
          K(row, 3 * cell.nodes[j / 3] + j % 3) += cell.stiffness[i][j];
      }
    }
    const Forces3 force = mesh.forces(blocks);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_NEAR(sum[i], force[i / 3][i % 3], 1e-13 * stone.young);
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-13 * K.norm());

    const double h = 1e-4;
    for (unsigned int j = 0; j < n; ++j)
    {
      double &u           = mesh.nodes[j / 3].u[j % 3];
      const double before = u;
      const auto at       = [&](const double x)
      {
        u = before + x;
        return mesh.forces(blocks);
      };
      const Forces3 p = at(h), m = at(-h), pp = at(2. * h), mm = at(-2. * h);
      u = before;
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto f = [i](const Forces3 &a) { return a[i / 3][i % 3]; };
        EXPECT_NEAR((8. * (f(p) - f(m)) - (f(pp) - f(mm))) / (12. * h),
                    -K(i, j), 1e-9 * K.norm());
      }
    }
  }
}

TEST(BlockForces3, InvertedCellsAreFound)
{
  TetrahedronBlocks mesh;
  mesh.add_box({ 2, 2, 2 }, { 1., 1., 1. });
  mesh.data.stiffness   = { space_stiffness(stone) };
  BlockForces<3> blocks = mesh.prepared();
  mesh.displace(rotation(3., { 1., 2., 3. }));
  EXPECT_EQ(first_inverted_cell(blocks, mesh.nodes.data()),
            blocks.cell_data().cells.size());

  // A corner pushed through its cell: the forces push it back.
  mesh.displace(Matrix3d::Identity());
  mesh.nodes[0].u[0] = mesh.nodes[0].u[1] = mesh.nodes[0].u[2] = 0.6;
  EXPECT_LT(first_inverted_cell(blocks, mesh.nodes.data()),
            blocks.cell_data().cells.size());
  const Forces3 force = mesh.forces(blocks);
  EXPECT_LT(force[0][0] + force[0][1] + force[0][2], 0.);

  std::swap(mesh.data.cells[5][0], mesh.data.cells[5][1]);
  blocks.prepare(mesh.data);
  mesh.displace(Matrix3d::Identity());
  EXPECT_EQ(first_inverted_cell(blocks, mesh.nodes.data()), 5u);
}

TEST(BlockForces3d, YieldingBlocksAgreeWithSingleCells)
{
  for (const bool with_stress : { false, true })
    for (const unsigned int n_lanes : { 4u, 8u })
    {
      TetrahedronBlocks mesh = assorted_blocks();
      mesh.data.laws.resize(2);
      mesh.data.laws[0].emplace(stone,
                                MohrCoulombStrength{ 2e6, 0.6, 0.2, 1e6 });
      if (with_stress)
        mesh.add_initial_stress(1e6);
      BlockForcesOptions options;
      options.n_lanes       = n_lanes;
      BlockForces<3> blocks = mesh.prepared(options);
      PlasticHistory a = initial_history(blocks), b = a;
      for (unsigned int step = 0; step < 4; ++step)
      {
        mesh.displace(rotation(0.5 * step, { 1., 2., -1. }));
        mesh.disturb(1e-5 * (1 + step));
        Forces3 force_a = mesh.zero(), force_b = force_a;
        double lost_a = 0., lost_b = 0.;
        for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
        {
          lost_a
              += blocks.add_forces(tile, mesh.nodes.data(), a, force_a.data());
          lost_b += add_forces_by_cell(blocks, tile, mesh.nodes.data(), b,
                                       force_b.data());
        }
        EXPECT_GT(lost_b, 0.);
        EXPECT_NEAR(lost_a, lost_b, 1e-9 * lost_b);
        EXPECT_LT(largest_difference(force_a, force_b),
                  1e-9 * largest(force_b));
        unsigned int n_yielded = 0;
        for (std::size_t k = 0; k < mesh.data.cells.size(); ++k)
        {
          EXPECT_EQ(a.yielding[k], b.yielding[k]);
          EXPECT_NEAR(a.shear[k], b.shear[k], 1e-12);
          n_yielded += (a.yielding[k] & 3) != 0;
          EXPECT_TRUE(mesh.data.law_of(k) || a.yielding[k] == 0);
        }
        EXPECT_GT(n_yielded, 100u);
        // Forces of blocks add up to nothing.
        Vector3d sum = Vector3d::Zero();
        for (const dealii::Tensor<1, 3> &f : force_a)
          sum += vector(f);
        EXPECT_LT(sum.norm(), 1e-9 * largest(force_a));
      }
    }
}

TEST(BlockForces3d, ForcesOfYieldedCellsAreThoseOfTheirEnergy)
{
  // Within the elastic domain after flow.
  TetrahedronBlocks mesh;
  mesh.add_box({ 2, 2, 2 }, { 1., 0.9, 1.1 }, { 0., 0., 0. }, 0.2);
  mesh.data.stiffness = { space_stiffness(stone) };
  mesh.data.laws.resize(1);
  mesh.data.laws[0].emplace(stone, MohrCoulombStrength{ 2e6, 0.6, 0.2 });
  mesh.add_initial_stress(5e5);
  BlockForces<3> blocks  = mesh.prepared();
  PlasticHistory history = initial_history(blocks);
  mesh.disturb(3e-4);
  EXPECT_GT(blocks.update(mesh.nodes.data(), history), 0.);
  // Back by a part of the elastic strain.
  for (NodeRecord<3> &node : mesh.nodes)
    for (double &u : dealii::make_array_view(node.u))
      u *= 0.99;
  PlasticHistory same = history;
  Forces3 force       = mesh.zero();
  for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
    blocks.add_forces(tile, mesh.nodes.data(), same, force.data());
  unsigned int n_checked = 0;
  for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
    {
      // Of nodes whose cells are all elastic here.
      bool is_elastic = true;
      for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
        for (const unsigned int node : mesh.data.cells[k])
          is_elastic = is_elastic && (node != i || (same.yielding[k] & 3) == 0);
      if (!is_elastic)
        continue;
      ++n_checked;
      const double u = mesh.nodes[i].u[d], h = 1e-8;
      double energy[2];
      for (unsigned int side = 0; side < 2; ++side)
      {
        mesh.nodes[i].u[d] = u + (side == 0 ? -h : h);
        energy[side]       = strain_energy(blocks, mesh.nodes.data(), history);
      }
      mesh.nodes[i].u[d] = u;
      EXPECT_NEAR(force[i][d], -(energy[1] - energy[0]) / (2. * h),
                  1e-5 * largest(force));
    }
  EXPECT_GT(n_checked, 10u);
}

TEST(BlockForces3d, StiffnessOfYieldingCellsIsTheDerivativeOfTheirForces)
{
  TetrahedronBlocks mesh;
  mesh.add_box({ 1, 1, 1 }, { 1., 0.8, 1.2 });
  mesh.data.stiffness = { space_stiffness(stone) };
  mesh.data.laws.resize(1);
  mesh.data.laws[0].emplace(stone, MohrCoulombStrength{ 2e6, 0.6, 0.2, 1e6 });
  mesh.add_initial_stress(5e5);
  BlockForces<3> blocks  = mesh.prepared();
  PlasticHistory history = initial_history(blocks);
  unsigned int n_yielded = 0;
  for (unsigned int step = 0; step < 3; ++step)
  {
    // Elastic at first, then beyond what bears.
    mesh.displace(rotation(0.3 * step, { 0.2, 1., 1. }));
    mesh.disturb(step == 0 ? 1e-6 : 3e-4 * step);
    PlasticHistory end = history;
    Forces3 force      = mesh.zero();
    double lost        = 0.;
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      lost += blocks.add_forces(tile, mesh.nodes.data(), end, force.data());
    double dissipated = 0.;
    for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
    {
      PlasticHistory trial = history;
      CellLinearisation cell;
      ASSERT_TRUE(linearise_cell(blocks.cell_data(), k, mesh.nodes.data(),
                                 trial, cell));
      dissipated += cell.dissipated;
      n_yielded += (trial.yielding[k] & 3) != 0;
      EXPECT_EQ(trial.yielding[k], end.yielding[k]);
      double scale = 0.;
      for (const auto &row : cell.stiffness)
        for (const double entry : row)
          scale = std::max(scale, std::abs(entry));
      for (unsigned int i = 0; i < 12; ++i)
        force[cell.nodes[i / 3]][i % 3] -= cell.force[i];
      for (unsigned int j = 0; j < 12; ++j)
      {
        double &u           = mesh.nodes[cell.nodes[j / 3]].u[j % 3];
        const double before = u, h = 1e-8;
        std::array<double, 12> ends[2];
        for (const unsigned int side : { 0U, 1U })
        {
          u     = before + (side == 0 ? -h : h);
          trial = history;
          CellLinearisation there;
          linearise_cell(blocks.cell_data(), k, mesh.nodes.data(), trial, there,
                         false);
          ends[side] = there.force;
        }
        u = before;
        for (unsigned int i = 0; i < 12; ++i)
          EXPECT_NEAR((ends[1][i] - ends[0][i]) / (2. * h),
                      -cell.stiffness[i][j], 1e-5 * scale);
      }
    }
    EXPECT_NEAR(dissipated, lost, 1e-12 * (1. + lost));
    EXPECT_LT(largest(force), 1e-9 * stone.young);
    history = end;
  }
  EXPECT_GT(n_yielded, 6u);
}
