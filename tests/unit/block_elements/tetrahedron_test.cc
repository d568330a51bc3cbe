// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../blocks/tetrahedron_blocks.h"

#include <quoin/block_elements/cell_tangent.h>

#include <gtest/gtest.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  const LinearElastic stone{ 2700., 30e9, 0.2 };

  struct Decomposition
  {
    PolarDecomposition<OneLane> polar;
    Matrix3d R, e;

    explicit Decomposition(const Matrix3d &H)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          polar.H[i][j] = H(i, j);
      polar.find_tensors();
      polar.find_trace();
      double rows[3][3], strain[6];
      polar.rotation_and_strain(rows, strain);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          R(i, j) = rows[i][j];
          e(i, j) = strain[symmetric_index[i][j]];
        }
    }
  };

  Matrix3d random_symmetric(std::mt19937 &random, const double size)
  {
    std::uniform_real_distribution<double> uniform(-size, size);
    Matrix3d a;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        a(i, j) = a(j, i) = uniform(random);
    return a;
  }

  /** R - I with all digits, however small the angle. */
  Matrix3d turn(const double angle, const Vector3d &axis)
  {
    const Vector3d n = axis.normalized();
    Matrix3d K;
    K << 0., -n[2], n[1], n[2], 0., -n[0], -n[1], n[0], 0.;
    const double s = std::sin(0.5 * angle);
    return std::sin(angle) * K + 2. * s * s * K * K;
  }

  Vector3d random_axis(std::mt19937 &random)
  {
    std::normal_distribution<double> normal;
    return { normal(random), normal(random), normal(random) };
  }
} // namespace

TEST(Tetrahedron, PolarDecomposition)
{
  // Both sides of where the iteration begins to be needed, and far beyond.
  std::mt19937 random(3);
  for (const double size : { 1e-12, 1e-7, 1e-4, 4e-4, 6e-4, 1e-2, 0.2 })
    for (const double angle : { 0., 1e-9, 1e-3, 0.5, 2., 3.14159265358979 })
      for (unsigned int sample = 0; sample < 20; ++sample)
      {
        const Matrix3d e = random_symmetric(random, size);
        const Matrix3d Q = turn(angle, random_axis(random));
        const Matrix3d R = Matrix3d::Identity() + Q;
        const Decomposition found(Q + e + Q * e);
        // Digits of the strain are lost to those of the rotation alone.
        const double tolerance = 4e-15 * std::min(angle, 1.) + 3e-15 * size;
        EXPECT_LT((found.e - e).cwiseAbs().maxCoeff(), tolerance)
            << size << ' ' << angle;
        EXPECT_LT((found.R - R).cwiseAbs().maxCoeff(), 4e-15);
        EXPECT_NEAR(found.polar.a, e.trace(), tolerance);
      }
}

TEST(Tetrahedron, PolarDecompositionOfLargeStretches)
{
  std::mt19937 random(4);
  for (const Vector3d &stretch :
       { Vector3d(3., 0.1, 0.5), Vector3d(1., 1., 1e-3), Vector3d(20., 1., 1.),
         Vector3d(0.2, 0.3, 0.25), Vector3d(1., 0.8, -0.3) })
  {
    const Matrix3d V = rotation(1.1, random_axis(random));
    const Matrix3d U = V * stretch.asDiagonal() * V.transpose();
    const Matrix3d R = rotation(2.2, random_axis(random));
    const Decomposition found(R * U - Matrix3d::Identity());
    const double size = stretch.cwiseAbs().maxCoeff();
    EXPECT_LT((found.e + Matrix3d::Identity() - U).cwiseAbs().maxCoeff(),
              1e-11 * size);
    EXPECT_LT((found.R - R).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(Tetrahedron, ElasticStressIsThatOfTheStrain)
{
  std::mt19937 random(6);
  const SpaceStiffness C = space_stiffness(stone);
  for (const double size : { 1e-6, 1e-2 })
  {
    const Matrix3d e = random_symmetric(random, size);
    const Matrix3d R = rotation(0.7, random_axis(random));
    const Decomposition d((R - Matrix3d::Identity()) + R * e);
    double P[3][3];
    d.polar.elastic_stress({ C.lambda, C.mu }, P);
    const Matrix3d expected
        = R * (C.lambda * e.trace() * Matrix3d::Identity() + 2. * C.mu * e);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        EXPECT_NEAR(P[i][j], expected(i, j), 1e-14 * stone.young);
  }
}

TEST(Tetrahedron, StiffnessIsThatOfAUniaxialTest)
{
  // Stress E e with lateral strain -nu e, none on the sides.
  const SpaceStiffness C = space_stiffness(stone);
  const double nu        = stone.poisson;
  EXPECT_NEAR(C.lambda * (1. - 2. * nu) + 2. * C.mu, stone.young,
              1e-9 * stone.young);
  EXPECT_NEAR(C.lambda * (1. - 2. * nu) - 2. * C.mu * nu, 0.,
              1e-9 * stone.young);
}

TEST(Tetrahedron, LargestFrequencyOfOneElement)
{
  // Of the stiffness at rest, also where Poisson's ratio is negative.
  for (const double poisson : { 0.2, 0.45, 0., -0.7 })
  {
    const LinearElastic material{ 2000., 1e9, poisson };
    TetrahedronBlocks mesh;
    mesh.add_box({ 2, 2, 2 }, { 1., 1.5, 0.6 }, Vector3d::Zero(), 0.3);
    mesh.data.stiffness   = { space_stiffness(material) };
    BlockForces<3> blocks = mesh.prepared();
    for (unsigned int k = 0; k < blocks.cell_data().cells.size(); ++k)
    {
      CellLinearisation cell;
      PlasticHistory none;
      linearise_cell(blocks.cell_data(), k, mesh.nodes.data(), none, cell);
      Eigen::Matrix<double, 12, 12> K;
      for (unsigned int i = 0; i < 12; ++i)
        for (unsigned int j = 0; j < 12; ++j)
          K(i, j) = cell.stiffness[i][j];
      const auto geometry = mesh.geometry(k);
      const double m      = material.density * geometry.det / 24.;
      const double exact
          = Eigen::SelfAdjointEigenSolver<decltype(K)>(K).eigenvalues()(11) / m;
      EXPECT_NEAR(largest_eigenvalue_squared_frequency(
                      geometry, mesh.data.stiffness[0], material.density),
                  exact, 1e-10 * exact)
          << poisson;
    }
  }
}
