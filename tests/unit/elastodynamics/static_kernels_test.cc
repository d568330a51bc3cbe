// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/laplace_matrices.h>
#include <quoin/elastodynamics/static_kernels.h>
#include <quoin/elastodynamics/time_kernels.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  const ElasticMedium medium{ 2., std::sqrt(3.), 1. };

  Boundary rectangle(const bool exterior)
  {
    return Boundary::polygon(
        { { 0.1, 0. }, { 2., 0.2 }, { 2.4, 1.3 }, { 0., 1. } }, 0.31, exterior);
  }

  Eigen::MatrixXd row_sums(const Eigen::MatrixXd &H)
  {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(H.rows(), 2);
    for (unsigned k = 0; k < H.cols(); ++k)
      sums.col(k % 2) += H.col(k);
    return sums;
  }
} // namespace

class StaticMatricesOf : public testing::TestWithParam<Projection>
{
};

TEST_P(StaticMatricesOf, rigid_translation)
{
  const auto interior = static_matrices(rectangle(false), medium, GetParam());
  EXPECT_LT(row_sums(interior.H).norm(), 1e-12);

  const auto exterior  = static_matrices(rectangle(true), medium, GetParam());
  Eigen::MatrixXd sums = row_sums(exterior.H);
  for (unsigned k = 0; k < sums.rows(); ++k)
    sums(k, k % 2) -= 1.;
  EXPECT_LT(sums.norm(), 1e-12);
}

// The Laplace matrices, by quadrature, at a frequency close to zero.
TEST_P(StaticMatricesOf, are_limits_of_laplace_matrices)
{
  Boundary boundary = rectangle(true);
  // Far, of another size, and parallel.
  boundary.elements.push_back({ { 9., 1. }, { 8., 1.5 } });
  boundary.elements.push_back({ { 0.5, -0.05 }, { 0.2, -0.05 } });
  const auto laplace  = laplace_matrices(boundary, medium, 1e-7, GetParam());
  const auto matrices = static_matrices(boundary, medium, GetParam());
  EXPECT_LT((laplace.H.real() - matrices.H).lpNorm<Eigen::Infinity>(), 1e-10);

  // G but for a constant times the length of the column's element.
  const dealii::Point<2> d(0.3, 0.4);
  const Eigen::Matrix2d constant
      = (LaplaceKernels(medium, 1e-7).displacement(d).real()
         - static_displacement_kernel(medium, d));
  EXPECT_NEAR(constant(0, 1), 0., 1e-12);
  Eigen::MatrixXd G = laplace.G.real() - matrices.G;
  for (unsigned e = 0; e < boundary.n_elements(); ++e)
    for (unsigned f = 0; f < boundary.n_elements(); ++f)
      G.block<2, 2>(2 * e, 2 * f) -= boundary.elements[f].length() * constant;
  EXPECT_LT(G.lpNorm<Eigen::Infinity>(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Both, StaticMatricesOf,
                         testing::Values(Projection::collocation,
                                         Projection::galerkin));

TEST(StaticMatrices, are_reciprocal)
{
  const Boundary boundary = rectangle(false);
  const auto matrices
      = static_matrices(boundary, medium, Projection::galerkin, 3.);
  Eigen::MatrixXd G = matrices.G;
  for (unsigned k = 0; k < G.rows(); ++k)
    G.row(k) *= boundary.elements[k / 2].length();
  EXPECT_LT((G - G.transpose()).norm(), 1e-13 * G.norm());
}

TEST(StaticMatrices, close_to_far_formula_joins)
{
  // On both sides of the distance at which the formula changes.
  const auto entry = [](const double x)
  {
    Boundary boundary;
    boundary.elements
        = { { { 0., 0. }, { 1., 0. } }, { { x, 0.3 }, { x + 0.5, 1. } } };
    return static_matrices(boundary, medium, Projection::galerkin);
  };
  const double x  = 0.25 + std::sqrt(36. - 0.65 * 0.65);
  const auto near = entry(x - 1e-9), far = entry(x + 1e-9);
  EXPECT_LT((near.G - far.G).norm(), 1e-9);
  EXPECT_LT((near.H - far.H).norm(), 1e-9);
}

TEST(StaticMatrices, reference_length_adds_a_constant)
{
  const Boundary boundary = rectangle(false);
  const auto one = static_matrices(boundary, medium, Projection::galerkin);
  const auto ten = static_matrices(boundary, medium, Projection::galerkin, 10.);
  const dealii::Point<2> d(0.3, 0.4);
  const double constant = (static_displacement_kernel(medium, d, 10.)
                           - static_displacement_kernel(medium, d))(0, 0);
  EXPECT_NEAR(ten.G(0, 6) - one.G(0, 6),
              constant * boundary.elements[3].length(), 1e-14);
  EXPECT_EQ(ten.H, one.H);
}
