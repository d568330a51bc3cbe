// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/tdbem/clustered_history.h>
#include <quoin/tdbem/convolution_quadrature.h>
#include <quoin/tdbem/direct_history.h>
#include <quoin/tdbem/influence_matrices.h>

#include <gtest/gtest.h>

#include <random>

using namespace quoin;
using Eigen::VectorXd;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2., 2.5, 0.25);

  /** Two curves with corners and unequal elements, of @p length and @p n. */
  Boundary two_holes(const double length = 0.24, const unsigned int n = 12)
  {
    Boundary boundary = Boundary::polygon(
        { { 0., 0. }, { 1., 0. }, { 1.2, 0.7 }, { 0.1, 0.6 } }, length, true);
    const Boundary circle = Boundary::circle({ 3., 1. }, 0.6, n, true);
    boundary.elements.insert(boundary.elements.end(), circle.elements.begin(),
                             circle.elements.end());
    return boundary;
  }

  /**
   * Greatest difference of the two sums, relative to the greatest sum, over
   * @p n_steps with displacements and tractions that change at random.
   */
  double difference(BoundaryHistory &one, BoundaryHistory &other,
                    const unsigned n, const unsigned n_steps)
  {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    VectorXd u = VectorXd::Zero(n), p = u;
    double error = 0., size = 0.;
    for (unsigned step = 0; step < n_steps; ++step)
    {
      const VectorXd sum = one.predict();
      error = std::max(error, (sum - other.predict()).cwiseAbs().maxCoeff());
      size  = std::max(size, sum.cwiseAbs().maxCoeff());
      for (unsigned k = 0; k < n; ++k)
      {
        u(k) = 0.9 * u(k) + 1e-3 * normal(random);
        p(k) = 0.9 * p(k) + 1e-2 * normal(random);
      }
      one.push(u, p);
      other.push(u, p);
    }
    return error / size;
  }
} // namespace

/** Against the direct sum, far beyond the lags that are kept. */
TEST(ClusteredHistory, time_domain)
{
  const Boundary boundary = two_holes();
  for (const Projection projection :
       { Projection::galerkin, Projection::collocation })
    for (const double decay : { 0., 0.02 })
    {
      InfluenceMatrices::Options options;
      options.projection = projection;
      options.decay      = decay;
      const InfluenceMatrices kernel(boundary, medium, 0.1, options);
      for (const double tolerance : { 1e-3, 1e-6 })
      {
        ClusteredHistory::Options compression;
        compression.tolerance = tolerance;
        compression.n_steps   = 1000;
        ClusteredHistory history(kernel, boundary, compression, MPI_COMM_SELF);
        DirectHistory direct(kernel);
        const double error = difference(history, direct, kernel.size(), 250);
        EXPECT_LT(error, tolerance);
        EXPECT_LT(history.decay_error(kernel), 20. * tolerance);
        EXPECT_GT(250, 2 * history.n_lags());
      }
    }
}

TEST(ClusteredHistory, convolution_quadrature)
{
  const Boundary boundary = two_holes(0.36, 8);
  for (const RayleighDamping &damping :
       { RayleighDamping{ 0., 0. }, RayleighDamping{ 0.3, 0.02 } })
  {
    const ConvolutionQuadrature kernel(boundary, medium, 0.1, 160,
                                       Projection::galerkin, damping);
    ClusteredHistory::Options compression;
    compression.tolerance = 1e-6;
    compression.n_steps   = 1000;
    ClusteredHistory history(kernel, boundary, compression, MPI_COMM_SELF);
    DirectHistory direct(kernel);
    const double error = difference(history, direct, kernel.size(), 160);
    EXPECT_LT(error, 1e-6);
  }
}

/** Interrupted in the middle of a block. */
TEST(ClusteredHistory, resume_is_bitwise)
{
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 16, true);
  const InfluenceMatrices kernel(boundary, medium, 0.4);
  ClusteredHistory whole(kernel, boundary, {}, MPI_COMM_SELF);
  ClusteredHistory again(kernel, boundary, {}, MPI_COMM_SELF);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto any = [&]
  {
    return VectorXd(VectorXd::NullaryExpr(32, [&] { return uniform(random); }));
  };
  for (unsigned step = 0; step < 150; ++step)
  {
    if (step == 83)
      again.restore(whole.save());
    const VectorXd sum = whole.predict();
    if (step >= 83)
    {
      EXPECT_EQ(sum, again.predict());
    }
    const VectorXd u = any(), p = any();
    whole.push(u, p);
    if (step >= 83)
      again.push(u, p);
  }
  EXPECT_EQ(again.n_steps(), 150u);
  EXPECT_THROW(again.restore({ { 1., 2. }, {} }), InputError);
}

/** Sums over all lags, of which the plain ones must be cut off late. */
TEST(ClusteredHistory, transform)
{
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 16, true);
  const InfluenceMatrices kernel(boundary, medium, 0.3);
  const ClusteredHistory history(kernel, boundary, {}, MPI_COMM_SELF);
  const ZTransform fast = history.transform(kernel);
  const ZTransform slow = z_transform(kernel, 800);
  Eigen::MatrixXcd G1, H1, G2, H2;
  for (const double angle : { 0., 0.1, 1., 3. })
  {
    const std::complex<double> w = std::polar(0.98, angle);
    fast(w, G1, H1);
    slow(w, G2, H2);
    EXPECT_LT((G1 - G2).cwiseAbs().maxCoeff(), 1e-6 * G2.cwiseAbs().maxCoeff());
    EXPECT_LT((H1 - H2).cwiseAbs().maxCoeff(), 1e-6 * H2.cwiseAbs().maxCoeff());
  }
}

/** Damping that spreads the fronts over more than the usual lags. */
TEST(ClusteredHistory, stiffness_damping)
{
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 8, true);
  for (const double stiffness : { 0.3, 3. })
  {
    const ConvolutionQuadrature kernel(boundary, medium, 0.3, 500,
                                       Projection::galerkin,
                                       RayleighDamping{ 0., stiffness });
    ClusteredHistory::Options compression;
    compression.n_steps = 1000;
    ClusteredHistory history(kernel, boundary, compression, MPI_COMM_SELF);
    DirectHistory direct(kernel);
    EXPECT_LT(difference(history, direct, kernel.size(), 500), 1e-6);
  }
}

/** Fewer steps than a wave takes: no more lags than steps, and all are kept. */
TEST(ClusteredHistory, short_run)
{
  const Boundary boundary = two_holes();
  const InfluenceMatrices kernel(boundary, medium, 0.005);
  ClusteredHistory::Options compression;
  compression.n_steps = 20;
  ClusteredHistory history(kernel, boundary, compression, MPI_COMM_SELF);
  DirectHistory direct(kernel);
  EXPECT_LE(history.n_lags(), 64u);
  EXPECT_LT(difference(history, direct, kernel.size(), 20), 1e-12);
}
