// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Blocks of tetrahedra in time, against closed forms.

#include "tetrahedron_blocks.h"

#include <quoin/block_elements/cell_tangent.h>

#include <gtest/gtest.h>

#include <memory>

using namespace quoin;
using namespace quoin::test;

namespace
{
  const LinearElastic stone{ 2700., 30e9, 0.2 };

  /** Sums over all nodes; velocities are those of half a step ago. */
  struct Motion
  {
    Vector3d momentum = Vector3d::Zero();
    Vector3d angular  = Vector3d::Zero();
    Matrix3d inertia  = Matrix3d::Zero(); /**< sum m x x^T about the centre */
    double energy     = 0.;

    Motion(const FreeBlocks &free, const Forces3 &before)
    {
      const TetrahedronBlocks &mesh = free.mesh;
      for (unsigned int i = 0; i < free.mass.size(); ++i)
      {
        const Vector3d x = vector(mesh.nodes[i].X) + vector(mesh.nodes[i].u);
        const Vector3d v = vector(free.velocity[i]);
        momentum += free.mass[i] * v;
        angular += free.mass[i] * x.cross(v);
        energy += 0.5 * free.mass[i] * v.dot(vector(before[i]));
      }
    }
  };

  /** Places a column along e_z of @p n cells so that it is along R e_z. */
  void turn_reference(TetrahedronBlocks &mesh, const Matrix3d &R)
  {
    for (NodeRecord<3> &node : mesh.nodes)
    {
      const Vector3d X = R * vector(node.X);
      std::copy(X.data(), X.data() + 3, node.X.begin_raw());
    }
  }

  /** A column whose cross-sections move as a whole, in one direction: as if it
      were one of many side by side. Four nodes a level. */
  struct PlaneWaveColumn
  {
    static constexpr unsigned int n = 200;
    const double length             = 10.;
    const double width              = 0.05;
    TetrahedronBlocks mesh;
    std::unique_ptr<FreeBlocks> free;
    Vector3d axis, direction;

    explicit PlaneWaveColumn(const bool shear)
    {
      mesh.add_box({ 1, 1, n }, { width, width, length });
      const Matrix3d R = rotation(0.9, { 1., -0.6, 0.4 });
      turn_reference(mesh, R);
      axis      = R.col(2);
      direction = shear ? Vector3d(0.6 * R.col(0) + 0.8 * R.col(1)) : axis;
      free      = std::make_unique<FreeBlocks>(mesh, stone, 0.8);
    }

    double velocity(const unsigned int level) const
    {
      return vector(free->velocity[4 * level]).dot(direction);
    }

    double displacement(const unsigned int level) const
    {
      return vector(mesh.nodes[4 * level].u).dot(direction);
    }

    double height(const unsigned int level) const
    {
      return length * level / n;
    }

    void set(const unsigned int level, const double u, const double v)
    {
      for (unsigned int i = 4 * level; i < 4 * level + 4; ++i)
        for (unsigned int d = 0; d < 3; ++d)
        {
          mesh.nodes[i].u[d]   = u * direction[d];
          free->velocity[i][d] = v * direction[d];
        }
    }

    /** With dashpots of @p impedance [Pa s/m] at both ends, whose force is
        that of the mean velocity of the step. */
    void step(const double impedance)
    {
      const double before[2] = { velocity(0), velocity(n) };
      free->step([] {});
      for (unsigned int level = 0; level <= n; ++level)
      {
        double mass = 0., u = 0., v = 0.;
        for (unsigned int i = 4 * level; i < 4 * level + 4; ++i)
        {
          const double m = free->mass[i];
          mass += m;
          u += m * vector(mesh.nodes[i].u).dot(direction);
          v += m * vector(free->velocity[i]).dot(direction);
        }
        u /= mass;
        v /= mass;
        if (level == 0 || level == n)
        {
          const double beta = 0.5 * free->dt * impedance * width * width / mass;
          const double damped = (v - beta * before[level / n]) / (1. + beta);
          u += free->dt * (damped - v);
          v = damped;
        }
        set(level, u, v);
      }
    }

    double energy() const
    {
      double sum = strain_energy(free->blocks, mesh.nodes.data(), {});
      for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
        sum += 0.5 * free->mass[i] * vector(free->velocity[i]).squaredNorm();
      return sum;
    }
  };
} // namespace

TEST(TetrahedronWaves, FreeFlightKeepsMomentaAndEnergy)
{
  for (const Vector3d &axis :
       { Vector3d(1., 0.1, 0.), Vector3d(0., 1., 0.1), Vector3d(0.3, 0., 1.) })
  {
    TetrahedronBlocks mesh;
    mesh.add_box({ 3, 2, 4 }, { 1., 0.7, 1.3 }, { 3., 1., -2. }, 0.2);
    FreeBlocks free(mesh, stone, 0.7);
    const Vector3d spin = 60. * axis.normalized();
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    {
      const Vector3d v
          = Vector3d(1., -2., 3.) + spin.cross(vector(mesh.nodes[i].X));
      std::copy(v.data(), v.data() + 3, free.velocity[i].begin_raw());
    }
    const Motion start(free, free.velocity);
    double least = 1e300, most = 0.;
    for (unsigned int i = 0; i < 6000; ++i)
    {
      const Forces3 before = free.velocity;
      const double stored
          = i % 20 ? 0. : strain_energy(free.blocks, mesh.nodes.data(), {});
      free.step([] {});
      if (i % 20)
        continue;
      const double energy = stored + Motion(free, before).energy;
      least               = std::min(least, energy);
      most                = std::max(most, energy);
    }
    const Motion end(free, free.velocity);
    EXPECT_LT((end.momentum - start.momentum).norm(),
              1e-12 * start.momentum.norm());
    EXPECT_LT((end.angular - start.angular).norm(),
              1e-11 * start.angular.norm());
    EXPECT_LT(most - least, 1e-5 * most);
    EXPECT_NEAR(most, start.energy, 1e-5 * most);
    // More than a turn, and hardly any strain.
    EXPECT_GT(60. * 6000 * free.dt, 9.);
    EXPECT_LT(strain_energy(free.blocks, mesh.nodes.data(), {}), 1e-3 * most);
  }
}

TEST(TetrahedronWaves, SpinAboutTheMiddleAxisTurnsOver)
{
  // Euler's equations of the rigid body with the same nodes' masses.
  TetrahedronBlocks mesh;
  mesh.add_box({ 2, 3, 5 }, { 0.4, 0.9, 1.5 }, { -0.2, -0.45, -0.75 });
  FreeBlocks free(mesh, stone, 0.9);
  Vector3d centre = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  double mass     = 0.;
  for (unsigned int i = 0; i < free.mass.size(); ++i)
  {
    mass += free.mass[i];
    centre += free.mass[i] * vector(mesh.nodes[i].X);
    second += free.mass[i] * vector(mesh.nodes[i].X)
              * vector(mesh.nodes[i].X).transpose();
  }
  centre /= mass;
  second -= mass * centre * centre.transpose();
  const Matrix3d J = second.trace() * Matrix3d::Identity() - second;
  Vector3d omega(0.5, 50., 0.);
  for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
  {
    const Vector3d v = omega.cross(vector(mesh.nodes[i].X) - centre);
    std::copy(v.data(), v.data() + 3, free.velocity[i].begin_raw());
  }

  Matrix3d R      = Matrix3d::Identity();
  bool turned     = false;
  const auto rate = [&](const Vector3d &w) -> Vector3d
  { return J.inverse() * (J * w).cross(w); };
  for (unsigned int n = 0; n < 24000; ++n)
  {
    free.step([] {});
    // Velocities are those of half a step before.
    const double h    = free.dt;
    const Vector3d k1 = rate(omega), k2 = rate(omega + 0.5 * h * k1),
                   k3 = rate(omega + 0.5 * h * k2), k4 = rate(omega + h * k3);
    const Vector3d mean = omega + h / 6. * (k1 + k2 + k3);
    R                   = R * rotation(h * mean.norm(), mean);
    omega += h / 6. * (k1 + 2. * k2 + 2. * k3 + k4);
    turned = turned || omega[1] < -45.;
    if (n % 2000)
      continue;
    Matrix3d moments = Matrix3d::Zero();
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      moments += free.mass[i]
                 * (vector(mesh.nodes[i].X) + vector(mesh.nodes[i].u) - centre)
                 * (vector(mesh.nodes[i].X) - centre).transpose();
    EXPECT_LT((moments - R * second).norm(), 5e-3 * second.norm())
        << n << ' ' << omega.transpose();
  }
  EXPECT_TRUE(turned);
}

TEST(TetrahedronWaves, BarUnderASuddenEndLoad)
{
  // No lateral strain with Poisson's ratio 0: d'Alembert's solution of a bar,
  // c = sqrt(E/rho), with a free end far from the load.
  const LinearElastic material{ 2500., 10e9, 0. };
  TetrahedronBlocks mesh;
  const unsigned int n = 160;
  const double length = 8., width = 0.05, traction = 1e5;
  mesh.add_box({ 1, 1, n }, { width, width, length });
  const Matrix3d R = rotation(0.9, { 1., -0.6, 0.4 });
  turn_reference(mesh, R);
  FreeBlocks free(mesh, material, 0.9);
  const double c = std::sqrt(material.young / material.density);
  const double v = traction / (material.density * c);
  const double end_mass
      = free.mass[0] + free.mass[1] + free.mass[2] + free.mass[3];
  const auto displacement = [&](const unsigned int level)
  {
    double u = 0.;
    for (unsigned int i = 4 * level; i < 4 * level + 4; ++i)
      u += 0.25 * vector(mesh.nodes[i].u).dot(R.col(2));
    return u;
  };
  double time = 0.;
  while (time < 1.5 * length / c)
  {
    free.step(
        [&]
        {
          for (unsigned int i = 0; i < 4; ++i)
            for (unsigned int d = 0; d < 3; ++d)
              // At rest at time 0: half a step's impulse first.
              free.force[i][d] += (time > 0. ? 1. : 0.5) * traction * width
                                  * width * free.mass[i] / end_mass * R(d, 2);
        });
    time += free.dt;
    if (time > 0.3 * length / c && time < 0.31 * length / c)
    {
      EXPECT_NEAR(displacement(0), v * time, 0.01 * v * time);
      EXPECT_NEAR(displacement(n / 4), v * (time - 0.25 * length / c),
                  0.01 * v * time);
    }
  }
  // The free end moves twice as fast from L/c on; the middle has met the wave
  // and its reflection.
  const double scale = v * length / c;
  EXPECT_NEAR(displacement(n), 2. * v * (time - length / c), 0.01 * scale);
  EXPECT_NEAR(displacement(n / 2), v * (time - 0.5 * length / c), 0.01 * scale);
}

TEST(TetrahedronWaves, PlanePulsesTravelAndLeaveThroughDashpots)
{
  for (const bool shear : { false, true })
  {
    PlaneWaveColumn column(shear);
    const SpaceStiffness C = space_stiffness(stone);
    const double c
        = std::sqrt((shear ? C.mu : C.lambda + 2. * C.mu) / stone.density);
    const double size = 1e-6;
    const auto pulse  = [&](const double z)
    { return size * std::exp(-(z - 3.) * (z - 3.) / 0.5); };
    const double dt = column.free->dt;
    for (unsigned int level = 0; level <= column.n; ++level)
    {
      const double z = column.height(level);
      // Half a step ago.
      column.set(
          level, pulse(z),
          -c * (pulse(z + 1e-4 + 0.5 * c * dt) - pulse(z - 1e-4 + 0.5 * c * dt))
              / 2e-4);
    }
    const double energy = column.energy();
    double time         = 0.;
    while (time < 4. / c)
    {
      column.step(stone.density * c);
      time += dt;
    }
    for (unsigned int level = 0; level <= column.n; ++level)
      EXPECT_NEAR(column.displacement(level),
                  pulse(column.height(level) - c * time), 0.01 * size)
          << shear << ' ' << level;
    while (time < 15. / c)
    {
      column.step(stone.density * c);
      time += dt;
    }
    EXPECT_LT(column.energy(), 1e-5 * energy) << shear;
  }
}

TEST(TetrahedronWaves, StableStep)
{
  TetrahedronBlocks mesh;
  mesh.add_box({ 3, 2, 2 }, { 1., 0.5, 0.7 }, Vector3d::Zero(), 0.2);
  FreeBlocks free(mesh, stone, 1.);
  const unsigned int n = 3 * mesh.nodes.size();
  Eigen::MatrixXd K    = Eigen::MatrixXd::Zero(n, n);
  PlasticHistory none;
  for (unsigned int k = 0; k < free.blocks.cell_data().cells.size(); ++k)
  {
    CellLinearisation cell;
    linearise_cell(free.blocks.cell_data(), k, mesh.nodes.data(), none, cell);
    for (unsigned int i = 0; i < 12; ++i)
      for (unsigned int j = 0; j < 12; ++j)
      {
        const unsigned int a = 3 * cell.nodes[i / 3] + i % 3;
        const unsigned int b = 3 * cell.nodes[j / 3] + j % 3;
        K(a, b) += cell.stiffness[i][j]
                   / std::sqrt(free.mass[a / 3] * free.mass[b / 3]);
      }
  }
  const double exact
      = 2.
        / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K)
                        .eigenvalues()
                        .maxCoeff());
  EXPECT_LT(free.dt, exact);
  EXPECT_GT(free.dt, 0.7 * exact);

  const auto speed_after = [&](const double dt, const unsigned int n_steps)
  {
    mesh.displace(Matrix3d::Identity());
    mesh.disturb(1e-7);
    free.velocity = mesh.zero();
    free.force    = mesh.zero();
    free.dt       = dt;
    for (unsigned int i = 0; i < n_steps; ++i)
      free.step([] {});
    return largest(free.velocity);
  };
  EXPECT_LT(speed_after(0.99 * exact, 1000), 1.);
  EXPECT_GT(speed_after(1.01 * exact, 100), 100.);
}

TEST(TetrahedronWaves, LargestEigenvalueOfANode)
{
  // Principal values 1, 2, 7, turned.
  const Matrix3d R = rotation(0.7, { 1., 2., 3. });
  const Matrix3d S = R * Vector3d(1., 7., 2.).asDiagonal() * R.transpose();
  const StableTimeStep<3> bound({ components(S) });
  EXPECT_NEAR(bound.largest_eigenvalue({ 2. }), 3.5, 1e-14);
}
