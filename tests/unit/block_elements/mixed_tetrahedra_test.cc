// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Forces, energy, flow and derivatives of mixed tetrahedra.

#include "../blocks/tetrahedron_blocks.h"

#include <quoin/base/constants.h>
#include <quoin/block_elements/cell_tangent.h>
#include <quoin/blocks/cell_states.h>

#include <deal.II/base/array_view.h>

#include <gtest/gtest.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr unsigned int n_parts = parts_of_mixed;
  const LinearElastic stone{ 2700., 30e9, 0.2 };
  const LinearElastic brick{ 1900., 5e9, 0.33 };

  /** Cuts the tetrahedra of each block into eight. */
  void cut_blocks(TetrahedronBlocks &blocks)
  {
    const TetrahedronBlocks old = blocks;
    blocks.nodes.clear();
    blocks.data.cells.clear();
    blocks.data.block_first_cell = blocks.data.block_first_node = { 0 };
    blocks.data.mixed                                           = true;
    for (unsigned int b = 0; b + 1 < old.data.block_first_cell.size(); ++b)
    {
      MeshData<3> mesh;
      const unsigned int first_node = old.data.block_first_node[b];
      for (unsigned int i = first_node; i < old.data.block_first_node[b + 1];
           ++i)
        mesh.vertices.push_back(dealii::Point<3>(old.nodes[i].X));
      for (unsigned int c = old.data.block_first_cell[b];
           c < old.data.block_first_cell[b + 1]; ++c)
      {
        mesh.cells.push_back(old.data.cells[c]);
        for (unsigned int &v : mesh.cells.back())
          v -= first_node;
      }
      mesh.cell_group.resize(mesh.cells.size(), 0);
      make_mixed(mesh);
      const unsigned int begin = blocks.nodes.size();
      for (auto cell : mesh.cells)
      {
        for (unsigned int &v : cell)
          v += begin;
        blocks.data.cells.push_back(cell);
      }
      for (const dealii::Point<3> &x : mesh.vertices)
      {
        NodeRecord<3> record{};
        record.X = x;
        blocks.nodes.push_back(record);
      }
      blocks.data.block_first_cell.push_back(blocks.data.cells.size());
      blocks.data.block_first_node.push_back(blocks.nodes.size());
    }
  }

  TetrahedronBlocks one_box(const std::array<unsigned int, 3> &n,
                            const double jitter,
                            const LinearElastic &material = stone)
  {
    TetrahedronBlocks mesh;
    mesh.add_box(n, { 1., 0.8, 1.2 }, Vector3d::Zero(), jitter);
    cut_blocks(mesh);
    mesh.data.stiffness = { space_stiffness(material) };
    return mesh;
  }

  /** Blocks of very different sizes, two materials among them. */
  TetrahedronBlocks assorted_blocks()
  {
    TetrahedronBlocks mesh;
    mesh.add_box({ 4, 3, 3 }, { 1., 0.9, 1.1 }, { 0., 0., 0. }, 0.2);
    mesh.add_box({ 1, 1, 1 }, { 0.3, 0.2, 0.1 }, { 2., 0., 0. });
    mesh.add_box({ 2, 1, 3 }, { 0.3, 0.2, 0.1 }, { 2., 1., 0. });
    cut_blocks(mesh);
    mesh.data.stiffness = { space_stiffness(stone), space_stiffness(brick) };
    for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
      mesh.data.cell_stiffness.push_back(k / n_parts % 5 == 0);
    return mesh;
  }

  Matrix3d gradient(const TetrahedronBlocks &mesh, const unsigned int cell)
  {
    const auto &n = mesh.data.cells[cell];
    Matrix3d X, x;
    for (unsigned int k = 0; k < 3; ++k)
    {
      X.col(k) = vector(mesh.nodes[n[k + 1]].X - mesh.nodes[n[0]].X);
      x.col(k) = X.col(k) + vector(mesh.nodes[n[k + 1]].u - mesh.nodes[n[0]].u);
    }
    return x * X.inverse();
  }

  struct Polar
  {
    Matrix3d R, e;

    explicit Polar(const Matrix3d &F)
    {
      const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(F.transpose() * F);
      const Matrix3d U = solver.operatorSqrt();
      R                = F * U.inverse();
      e                = U - Matrix3d::Identity();
    }
  };

  /** Forces and, row by row, minus their derivative. */
  struct Linearised
  {
    Eigen::VectorXd force;
    Eigen::MatrixXd K;
    double dissipated = 0.;

    Linearised(const BlockForces<3> &blocks, const TetrahedronBlocks &mesh,
               PlasticHistory &history, const bool with_stiffness = true)
      : force(Eigen::VectorXd::Zero(3 * mesh.nodes.size())),
        K(Eigen::MatrixXd::Zero(force.size(), force.size()))
    {
      MixedLinearisation cell;
      for (unsigned int c = 0; c < mesh.data.cells.size(); c += n_parts)
      {
        linearise_mixed(blocks.cell_data(), c, mesh.nodes.data(), history, cell,
                        with_stiffness);
        dissipated += cell.dissipated;
        const auto place = [&](const unsigned int i)
        { return 3 * cell.nodes[i / 3] + i % 3; };
        for (unsigned int i = 0; i < 30; ++i)
        {
          force[place(i)] += cell.force[i];
          for (unsigned int j = 0; with_stiffness && j < 30; ++j)
            K(place(i), place(j)) += cell.stiffness[i][j];
        }
      }
    }
  };

  double add_forces(const BlockForces<3> &blocks, const TetrahedronBlocks &mesh,
                    PlasticHistory &history, Forces3 &force)
  {
    force       = mesh.zero();
    double lost = 0.;
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      lost += blocks.add_forces(tile, mesh.nodes.data(), history, force.data());
    return lost;
  }

  double &component(TetrahedronBlocks &mesh, const unsigned int j)
  {
    return mesh.nodes[j / 3].u[j % 3];
  }
} // namespace

TEST(MixedTetrahedra, RigidMotionMakesNoForce)
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

TEST(MixedTetrahedra, UniformStrainPatch)
{
  for (const double angle : { 0., 1.2, 3. })
    for (const double size : { 1e-6, 0.05 })
    {
      TetrahedronBlocks mesh = one_box({ 3, 3, 2 }, 0.3);
      BlockForces<3> blocks  = mesh.prepared();
      Matrix3d e;
      e << 1., 0.4, -0.3, 0.4, -0.5, 0.2, -0.3, 0.2, 0.7;
      e *= size;
      const Matrix3d I = Matrix3d::Identity();
      const Matrix3d R = rotation(angle, { 0.3, 1., -0.4 });
      mesh.displace(R * (I + e), { 1., 2., 3. });
      const SpaceStiffness C = mesh.data.stiffness[0];
      const Matrix3d S       = C.lambda * e.trace() * I + 2. * C.mu * e;
      const double tolerance = 1e-13 * stone.young;
      std::vector<SpaceTensor> stress, strain;
      cell_stresses(blocks, mesh.nodes.data(), {}, stress, strain);
      for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
      {
        EXPECT_LT(
            (matrix(stress[k]) - R * S * R.transpose()).cwiseAbs().maxCoeff(),
            tolerance);
        EXPECT_LT(
            (matrix(strain[k]) - R * e * R.transpose()).cwiseAbs().maxCoeff(),
            1e-13);
      }
      const Forces3 force    = mesh.forces(blocks);
      const double extent[3] = { 1., 0.8, 1.2 };
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
      }
    }
}

TEST(MixedTetrahedra, MeanStressIsSharedAndTheRestIsNot)
{
  TetrahedronBlocks mesh = one_box({ 2, 1, 1 }, 0.);
  mesh.add_initial_stress(1e8);
  BlockForces<3> blocks = mesh.prepared();
  mesh.displace(rotation(0.7, { 1., 1., -0.3 }));
  mesh.disturb(0.01);
  const double mu   = mesh.data.stiffness[0].mu,
               bulk = stone.young / 3. / (1. - 2. * stone.poisson);
  for (unsigned int first = 0; first < mesh.data.cells.size(); first += n_parts)
  {
    double volume = 0., growth = 0.;
    for (unsigned int k = first; k < first + n_parts; ++k)
    {
      volume += mesh.geometry(k).det;
      growth += mesh.geometry(k).det * Polar(gradient(mesh, k)).e.trace();
    }
    for (unsigned int k = first; k < first + n_parts; ++k)
    {
      const Polar polar(gradient(mesh, k));
      const double own = polar.e.trace();
      EXPECT_GT(std::abs(own - growth / volume), 1e-6);
      Matrix3d S = matrix(mesh.data.initial_stress[k]) + 2. * mu * polar.e;
      S += (bulk * growth / volume - 2. / 3. * mu * own) * Matrix3d::Identity();
      const Matrix3d want = polar.R * S * polar.R.transpose();
      EXPECT_LT((matrix(cell_stress(blocks, mesh.nodes.data(), {}, k)) - want)
                    .cwiseAbs()
                    .maxCoeff(),
                1e-12 * stone.young);
    }
  }
}

TEST(MixedTetrahedra, LanesAgreeWithCells)
{
  for (const double size : { 1e-5, 0.03 })
    for (const bool with_stress : { false, true })
      for (const unsigned int n_lanes : { 4u, 8u })
        for (const std::size_t tile_bytes : { 1u, 20000u, 1000000u })
        {
          TetrahedronBlocks mesh = assorted_blocks();
          if (with_stress)
            mesh.add_initial_stress(1e8);
          mesh.displace(rotation(1.9, { 1., 1., -0.3 }));
          mesh.disturb(0.05 * size);
          BlockForcesOptions options;
          options.n_lanes       = n_lanes;
          options.tile_bytes    = tile_bytes;
          options.max_run_cells = tile_bytes == 1u ? 37 : 4096;
          BlockForces<3> blocks = mesh.prepared(options);
          EXPECT_LT(largest_difference(mesh.forces(blocks),
                                       mesh.forces(blocks, true)),
                    1e-12 * stone.young);
          expect_energy_of_cells(blocks, mesh, size);
        }
}

TEST(MixedTetrahedra, ForcesAreThoseOfTheEnergy)
{
  for (const bool with_stress : { false, true })
  {
    TetrahedronBlocks mesh = one_box({ 1, 1, 1 }, 0.);
    if (with_stress)
      mesh.add_initial_stress(5e9);
    BlockForces<3> blocks = mesh.prepared();
    EXPECT_NEAR(strain_energy(blocks, mesh.nodes.data(), {}), 0.,
                1e-15 * stone.young);
    mesh.displace(rotation(0.8, { 0.2, 1., 1. }));
    mesh.disturb(0.03);
    const Forces3 force = mesh.forces(blocks);
    const double h      = 1e-6;
    for (unsigned int j = 0; j < 3 * mesh.nodes.size(); ++j)
    {
      const double before = component(mesh, j);
      double energy[2];
      for (const unsigned int side : { 0U, 1U })
      {
        component(mesh, j) = before + (side == 0 ? -h : h);
        energy[side]       = strain_energy(blocks, mesh.nodes.data(), {});
      }
      component(mesh, j) = before;
      EXPECT_NEAR(force[j / 3][j % 3], -(energy[1] - energy[0]) / (2. * h),
                  1e-7 * largest(force));
    }
  }
}

TEST(MixedTetrahedra, StiffnessIsTheDerivativeOfTheForces)
{
  for (const bool with_stress : { false, true })
  {
    TetrahedronBlocks mesh = one_box({ 1, 1, 1 }, 0.);
    if (with_stress)
      mesh.add_initial_stress(5e9);
    BlockForces<3> blocks = mesh.prepared();
    mesh.displace(rotation(0.8, { 0.2, 1., 1. }));
    mesh.disturb(0.02);
    PlasticHistory none;
    const Linearised at(blocks, mesh, none);
    const Forces3 force = mesh.forces(blocks);
    for (unsigned int i = 0; i < at.force.size(); ++i)
      EXPECT_NEAR(at.force[i], force[i / 3][i % 3], 1e-13 * stone.young);
    EXPECT_LT((at.K - at.K.transpose()).cwiseAbs().maxCoeff(),
              1e-13 * at.K.norm());
    const double h = 1e-5;
    for (unsigned int j = 0; j < at.force.size(); ++j)
    {
      const double before = component(mesh, j);
      component(mesh, j)  = before + h;
      const Forces3 plus  = mesh.forces(blocks);
      component(mesh, j)  = before - h;
      const Forces3 minus = mesh.forces(blocks);
      component(mesh, j)  = before;
      for (unsigned int i = 0; i < at.force.size(); ++i)
        EXPECT_NEAR((plus[i / 3][i % 3] - minus[i / 3][i % 3]) / (2. * h),
                    -at.K(i, j), 1e-7 * at.K.norm());
    }
  }
}

TEST(MixedTetrahedra, DampingIsThatOfTheStiffness)
{
  TetrahedronBlocks mesh = one_box({ 2, 2, 1 }, 0.2);
  BlockForces<3> blocks  = mesh.prepared();
  PlasticHistory none;
  const Linearised at_rest(blocks, mesh, none);
  const double beta = 1e-3;
  Eigen::VectorXd v(at_rest.force.size());
  Forces3 velocity = mesh.zero(), force = velocity;
  for (unsigned int i = 0; i < v.size(); ++i)
    velocity[i / 3][i % 3] = v[i] = mesh.uniform(1.);
  for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
    blocks.add_viscous_forces(tile, mesh.nodes.data(), velocity.data(), beta,
                              force.data());
  const Eigen::VectorXd want = -beta * at_rest.K * v;
  for (unsigned int i = 0; i < v.size(); ++i)
    EXPECT_NEAR(force[i / 3][i % 3], want[i],
                1e-12 * want.cwiseAbs().maxCoeff());
}

TEST(MixedTetrahedra, BoundOfTheStepHolds)
{
  // No frequency is above the bound by the plain cells' stiffness.
  for (const double poisson : { 0., 0.3, 0.49 })
  {
    TetrahedronBlocks mesh
        = one_box({ 2, 1, 2 }, 0., LinearElastic{ 2700., 30e9, poisson });
    BlockForces<3> blocks = mesh.prepared();
    PlasticHistory none;
    const Linearised at_rest(blocks, mesh, none);
    State<3> state;
    state.nodes = mesh.nodes;
    std::vector<NodeStiffness<3>> stiffness(mesh.nodes.size(),
                                            NodeStiffness<3>{});
    blocks.add_stiffness_bound(
        state, [](unsigned int, unsigned int) { return 1.; }, stiffness);
    const std::vector<double> mass = mesh.mass(2700.);
    Eigen::MatrixXd A              = at_rest.K;
    double bound                   = 0.;
    for (unsigned int i = 0; i < A.rows(); ++i)
    {
      bound = std::max(bound, stiffness[i / 3][i % 3] / mass[i / 3]);
      for (unsigned int j = 0; j < A.cols(); ++j)
        A(i, j) /= std::sqrt(mass[i / 3] * mass[j / 3]);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
    EXPECT_LT(solver.eigenvalues().maxCoeff(), bound);
    EXPECT_GT(solver.eigenvalues().maxCoeff(), 0.2 * bound);
    // Six rigid motions and no other motion without force.
    EXPECT_LT(std::abs(solver.eigenvalues()[5]), 1e-10 * bound);
    EXPECT_GT(solver.eigenvalues()[6], 1e-6 * bound);
  }
}

namespace
{
  /** Energy of a bar bent by a unit of curvature whose outer nodes are where
      the closed form has them, by that of the closed form. */
  double bending_energy(const bool mixed, const double poisson)
  {
    TetrahedronBlocks mesh
        = one_box({ 3, 3, 3 }, 0., LinearElastic{ 2700., 1., poisson });
    mesh.data.mixed        = mixed;
    BlockForces<3> blocks  = mesh.prepared();
    const double extent[3] = { 1., 0.8, 1.2 }, curvature = 1e-6;
    const unsigned int n = 3 * mesh.nodes.size();
    std::vector<unsigned int> free;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    {
      // About the middle of the bar; no change of volume if it is 0.5.
      const Vector3d x = vector(mesh.nodes[i].X) - Vector3d(0.5, 0.4, 0.6);
      bool inside      = true;
      for (unsigned int d = 0; d < 3; ++d)
        inside = inside && mesh.nodes[i].X[d] > 1e-9
                 && mesh.nodes[i].X[d] < extent[d] - 1e-9;
      mesh.nodes[i].u[0] = curvature * x[0] * x[1];
      mesh.nodes[i].u[1]
          = -0.5 * curvature
            * (x[0] * x[0] + poisson * (x[1] * x[1] - x[2] * x[2]));
      mesh.nodes[i].u[2] = -poisson * curvature * x[1] * x[2];
      for (unsigned int d = 0; inside && d < 3; ++d)
        free.push_back(3 * i + d);
    }
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    PlasticHistory none;
    const auto add = [&](const auto &cell)
    {
      for (unsigned int i = 0; i < 3 * cell.n_nodes; ++i)
        for (unsigned int j = 0; j < 3 * cell.n_nodes; ++j)
          K(3 * cell.nodes[i / 3] + i % 3, 3 * cell.nodes[j / 3] + j % 3)
              += cell.stiffness[i][j];
    };
    MixedLinearisation eight;
    CellLinearisation one;
    for (unsigned int c = 0; c < mesh.data.cells.size(); ++c)
      if (!mixed)
      {
        linearise_cell(mesh.data, c, mesh.nodes.data(), none, one);
        add(one);
      }
      else if (c % n_parts == 0)
      {
        linearise_mixed(mesh.data, c, mesh.nodes.data(), none, eight);
        add(eight);
      }
    Eigen::VectorXd u(n);
    for (unsigned int j = 0; j < n; ++j)
      u[j] = component(mesh, j);
    Eigen::MatrixXd inner(free.size(), free.size());
    Eigen::VectorXd load(free.size());
    const Eigen::VectorXd force = -K * u;
    for (unsigned int i = 0; i < free.size(); ++i)
    {
      load[i] = force[free[i]];
      for (unsigned int j = 0; j < free.size(); ++j)
        inner(i, j) = K(free[i], free[j]);
    }
    const Eigen::VectorXd change = inner.ldlt().solve(load);
    for (unsigned int i = 0; i < free.size(); ++i)
      u[free[i]] += change[i];
    const double moment_of_area = 1.2 * 0.8 * 0.8 * 0.8 / 12.;
    return u.dot(K * u) / (curvature * curvature * moment_of_area);
  }
} // namespace

TEST(MixedTetrahedra, BendingWithoutChangeOfVolumeDoesNotLock)
{
  // E I kappa^2 per length. The error of the mixed ones is that of a coarse
  // mesh, less with half the edges.
  EXPECT_NEAR(bending_energy(true, 0.3), 1., 0.1);
  EXPECT_NEAR(bending_energy(true, 0.4999), 1., 0.25);
  EXPECT_GT(bending_energy(false, 0.4999), 10.);
}

TEST(MixedTetrahedra, YieldingLanesAgreeWithSingleCells)
{
  for (const bool with_stress : { false, true })
  {
    TetrahedronBlocks mesh = assorted_blocks();
    mesh.data.laws.resize(2);
    mesh.data.laws[0].emplace(stone, MohrCoulombStrength{ 2e6, 0.6, 0.2, 1e6 });
    if (with_stress)
      mesh.add_initial_stress(1e6);
    BlockForces<3> blocks = mesh.prepared();
    PlasticHistory a = initial_history(blocks), b = a, c = a;
    for (unsigned int step = 0; step < 4; ++step)
    {
      mesh.displace(rotation(0.5 * step, { 1., 2., -1. }));
      mesh.disturb(1e-5 * (1 + step));
      Forces3 force, by_cell = mesh.zero();
      const double lost = add_forces(blocks, mesh, a, force);
      double lost_b     = 0.;
      for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
        lost_b += add_forces_by_cell(blocks, tile, mesh.nodes.data(), b,
                                     by_cell.data());
      EXPECT_GT(lost, 0.);
      EXPECT_NEAR(lost, lost_b, 1e-9 * lost);
      EXPECT_NEAR(blocks.update(mesh.nodes.data(), c), lost, 1e-9 * lost);
      EXPECT_LT(largest_difference(force, by_cell), 1e-9 * largest(force));
      unsigned int n_yielded = 0;
      for (std::size_t k = 0; k < mesh.data.cells.size(); ++k)
      {
        EXPECT_EQ(a.yielding[k], b.yielding[k]);
        EXPECT_EQ(a.yielding[k], c.yielding[k]);
        n_yielded += (a.yielding[k] & 3) != 0;
        EXPECT_TRUE(mesh.data.law_of(k) || a.yielding[k] == 0);
      }
      EXPECT_GT(n_yielded, 100u);
      Vector3d sum = Vector3d::Zero();
      for (const dealii::Tensor<1, 3> &f : force)
        sum += vector(f);
      EXPECT_LT(sum.norm(), 1e-9 * largest(force));
    }
  }
}

namespace
{
  /** A box that has yielded in part. */
  struct YieldedBox
  {
    TetrahedronBlocks mesh = one_box({ 1, 1, 1 }, 0.);
    BlockForces<3> blocks;
    PlasticHistory history;

    YieldedBox()
    {
      mesh.data.laws.resize(1);
      mesh.data.laws[0].emplace(stone, MohrCoulombStrength{ 2e6, 0.6, 0.1 });
      mesh.add_initial_stress(5e5);
      // So much pressure that cells yield in shear.
      for (SpaceTensor &stress : mesh.data.initial_stress)
        for (unsigned int i = 0; i < 3; ++i)
          stress[i] -= 10e6;
      blocks.prepare(mesh.data);
      history = initial_history(blocks);
      mesh.disturb(14e-5);
      EXPECT_GT(blocks.update(mesh.nodes.data(), history), 0.);
      const unsigned int n_yielded
          = mesh.data.cells.size()
            - std::count(history.yielding.begin(), history.yielding.end(), 0);
      EXPECT_GT(n_yielded, 10u);
      EXPECT_LT(n_yielded, mesh.data.cells.size());
    }
  };
} // namespace

TEST(MixedTetrahedra, ForcesAfterFlowAreThoseOfTheEnergy)
{
  YieldedBox box;
  TetrahedronBlocks &mesh = box.mesh;
  // Back by a part of the elastic strain, so that nothing yields now.
  for (NodeRecord<3> &node : mesh.nodes)
    for (double &u : dealii::make_array_view(node.u))
      u *= 0.8;
  PlasticHistory same = box.history;
  Forces3 force;
  add_forces(box.blocks, mesh, same, force);
  unsigned int n_checked = 0;
  for (unsigned int j = 0; j < 3 * mesh.nodes.size(); ++j)
  {
    bool is_elastic = true;
    for (unsigned int first = 0; first < mesh.data.cells.size();
         first += n_parts)
    {
      bool has_node = false, yields = false;
      for (unsigned int k = first; k < first + n_parts; ++k)
      {
        yields = yields || (same.yielding[k] & 3) != 0;
        for (const unsigned int node : mesh.data.cells[k])
          has_node = has_node || node == j / 3;
      }
      is_elastic = is_elastic && !(has_node && yields);
    }
    if (!is_elastic)
      continue;
    ++n_checked;
    const double before = component(mesh, j), h = 1e-8;
    double energy[2];
    for (const unsigned int side : { 0U, 1U })
    {
      component(mesh, j) = before + (side == 0 ? -h : h);
      energy[side] = strain_energy(box.blocks, mesh.nodes.data(), box.history);
    }
    component(mesh, j) = before;
    EXPECT_NEAR(force[j / 3][j % 3], -(energy[1] - energy[0]) / (2. * h),
                1e-5 * largest(force));
  }
  EXPECT_GT(n_checked, 10u);
}

TEST(MixedTetrahedra, StiffnessOfYieldingCellsIsTheDerivativeOfTheirForces)
{
  YieldedBox box;
  TetrahedronBlocks &mesh = box.mesh;
  mesh.displace(rotation(0.3, { 0.2, 1., 1. }));
  mesh.disturb(20e-5);
  PlasticHistory trial = box.history;
  const Linearised at(box.blocks, mesh, trial);
  EXPECT_GT(at.dissipated, 0.);
  unsigned int n_yielded = 0;
  for (const std::uint8_t state : trial.yielding)
    n_yielded += (state & 3) != 0;
  EXPECT_GT(n_yielded, 10u);
  // Explicit steps differ by what their next one makes up for.
  PlasticHistory end = box.history;
  Forces3 force;
  const double lost = add_forces(box.blocks, mesh, end, force);
  EXPECT_NEAR(at.dissipated, lost, 0.02 * lost);
  double largest_force = 0., largest_change = 0.;
  for (unsigned int i = 0; i < at.force.size(); ++i)
  {
    largest_force = std::max(largest_force, std::abs(at.force[i]));
    largest_change
        = std::max(largest_change, std::abs(at.force[i] - force[i / 3][i % 3]));
  }
  EXPECT_LT(largest_change, 0.02 * largest_force);
  const double h = 1e-8;
  for (unsigned int j = 0; j < at.force.size(); ++j)
  {
    const double before = component(mesh, j);
    Eigen::VectorXd ends[2];
    for (const unsigned int side : { 0U, 1U })
    {
      component(mesh, j) = before + (side == 0 ? -h : h);
      trial              = box.history;
      ends[side]         = Linearised(box.blocks, mesh, trial, false).force;
    }
    component(mesh, j) = before;
    for (unsigned int i = 0; i < at.force.size(); ++i)
      // But for terms of the size of the strain.
      EXPECT_NEAR((ends[1][i] - ends[0][i]) / (2. * h), -at.K(i, j),
                  1e-4 * at.K.cwiseAbs().maxCoeff());
  }
}

TEST(MixedTetrahedra, FlowOfALargeStepIsFlowOnce)
{
  // Again at the same positions it changes nothing.
  YieldedBox box;
  box.mesh.disturb(20e-5);
  const Linearised first(box.blocks, box.mesh, box.history);
  const Linearised again(box.blocks, box.mesh, box.history);
  EXPECT_GT(first.dissipated, 0.);
  EXPECT_LT(std::abs(again.dissipated), 1e-3 * first.dissipated);
  EXPECT_LT((again.force - first.force).norm(), 1e-3 * first.force.norm());
}

TEST(MixedTetrahedra, FlowKeepsTheEnergyBalance)
{
  // Work of the forces on a way there and back against what is lost.
  TetrahedronBlocks mesh = one_box({ 1, 1, 1 }, 0.);
  mesh.data.laws.resize(1);
  mesh.data.laws[0].emplace(stone, MohrCoulombStrength{ 2e6, 0.6, 0.2, 1e6 });
  BlockForces<3> blocks  = mesh.prepared();
  PlasticHistory history = initial_history(blocks);
  mesh.disturb(1e-4);
  const auto end       = mesh.nodes;
  const unsigned int n = 400;
  double work = 0., lost = 0.;
  Forces3 before = mesh.zero(), force;
  for (unsigned int step = 1; step <= n; ++step)
  {
    const double share = std::sin(1.5 * constants::pi * step / n),
                 last  = std::sin(1.5 * constants::pi * (step - 1.) / n);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      mesh.nodes[i].u = share * end[i].u;
    lost += add_forces(blocks, mesh, history, force);
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      work -= 0.5 * (share - last) * ((before[i] + force[i]) * end[i].u);
    before = force;
  }
  const double stored = strain_energy(blocks, mesh.nodes.data(), history);
  EXPECT_GT(lost, 0.3 * stored);
  EXPECT_NEAR(work, stored + lost, 1e-3 * work);
}
