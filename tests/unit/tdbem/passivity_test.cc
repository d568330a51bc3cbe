// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/base/exceptions.h>
#include <quoin/tdbem/convolution_quadrature.h>
#include <quoin/tdbem/influence_matrices.h>
#include <quoin/tdbem/passivity.h>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

using namespace quoin;

namespace
{
  const ElasticMedium medium{ 2., std::sqrt(3.), 1. };
  const Boundary circle = Boundary::circle({ 0., 0. }, 1., 16, true);

  double time_step(const double beta)
  {
    return beta * circle.elements[0].length() / medium.c1;
  }

  PassivityReport scan_convolution_quadrature(const Projection projection,
                                              const double beta)
  {
    const double dt = time_step(beta);
    return scan_passivity(
        [&](const std::complex<double> w, Eigen::MatrixXcd &G,
            Eigen::MatrixXcd &H)
        {
          const auto matrices = laplace_matrices(
              circle, medium, bdf2_symbol(w) / dt, projection);
          G = matrices.G;
          H = matrices.H;
        },
        circle, medium, dt, 60, 0.99);
  }

  PassivityReport scan_time_stepping(const Projection projection,
                                     const double beta)
  {
    InfluenceMatrices::Options options;
    options.projection = projection;
    const InfluenceMatrices kernel(circle, medium, time_step(beta), options);
    return scan_passivity(z_transform(kernel, 500), circle, medium,
                          kernel.time_step(), 100, 0.98);
  }
} // namespace

TEST(Passivity, z_transform_of_lags)
{
  const double dt = time_step(1.);
  const ConvolutionQuadrature kernel(circle, medium, dt, 120,
                                     Projection::collocation);
  const auto transform = z_transform(kernel, 120);
  const auto w         = std::polar(0.8, 0.7);
  Eigen::MatrixXcd G, H;
  transform(w, G, H);
  const auto exact = laplace_matrices(circle, medium, bdf2_symbol(w) / dt,
                                      Projection::collocation);
  EXPECT_LT((G - exact.G).norm(), 1e-9 * exact.G.norm());
  EXPECT_LT((H - exact.H).norm(), 1e-9 * exact.H.norm());
}

TEST(Passivity, convolution_quadrature_on_a_circle)
{
  const auto report = scan_convolution_quadrature(Projection::collocation, 1.);
  EXPECT_TRUE(report.passive());
  EXPECT_NE(report.advice().find("is passive"), std::string::npos);
  // Every mode radiates: at high frequencies nearly as a plane wave.
  EXPECT_GT(report.eigenvalues.back(), 0.3);
  EXPECT_LT(report.smallest_eigenvalue, 1.);
}

TEST(Passivity, time_stepping_on_a_circle)
{
  const auto collocation = scan_time_stepping(Projection::collocation, 0.6);
  const auto galerkin    = scan_time_stepping(Projection::galerkin, 0.6);
  EXPECT_FALSE(collocation.passive());
  EXPECT_LT(collocation.smallest_eigenvalue, -1.);
  EXPECT_NE(collocation.advice().find("Galerkin"), std::string::npos);
  EXPECT_GT(collocation.frequency, 0.);
  EXPECT_LT(collocation.frequency, collocation.nyquist);
  EXPECT_TRUE(galerkin.passive());
}

// A medium whose response is known: p = rho c v on every element, from
// G = I, H = (1 - w) rho c / dt I.
TEST(Passivity, dashpot)
{
  const double impedance = -0.3 * medium.density * medium.c2;
  const auto report      = scan_passivity(
      [&](const std::complex<double> w, Eigen::MatrixXcd &G,
          Eigen::MatrixXcd &H)
      {
        G = Eigen::MatrixXcd::Identity(32, 32);
        H = (1. - w) * impedance / 0.1 * G;
      },
      circle, medium, 0.1, 10, 0.99);
  EXPECT_NEAR(report.smallest_eigenvalue, -0.3, 1e-13);
  EXPECT_EQ(report.nyquist, 5.);
  EXPECT_EQ(report.frequencies.size(), report.n_scanned);
  EXPECT_GE(report.n_scanned, 10u);
  EXPECT_NE(report.advice().find("-0.3 rho c2"), std::string::npos);
}

// All eigenvalues of the same matrices.
TEST(Passivity, agrees_with_dense_eigenvalues)
{
  for (const Projection projection :
       { Projection::galerkin, Projection::collocation })
  {
    // Elements of two lengths and corners.
    const Boundary boundary = Boundary::polygon(
        { { 0., 0. }, { 1., 0. }, { 1., 0.5 }, { 0., 0.6 } }, 0.13, true);
    InfluenceMatrices::Options options;
    options.projection = projection;
    const InfluenceMatrices kernel(boundary, medium, 0.06, options);
    const ZTransform transform = z_transform(kernel, 300);
    std::map<double, double> expected;
    const auto report = scan_passivity(
        [&](const std::complex<double> w, Eigen::MatrixXcd &G,
            Eigen::MatrixXcd &H)
        {
          transform(w, G, H);
          Eigen::VectorXd root(H.rows());
          for (Eigen::Index k = 0; k < root.size(); ++k)
            root(k) = std::sqrt(boundary.elements[std::size_t(k / 2)].length());
          const Eigen::MatrixXcd Z
              = kernel.time_step() / (1. - w)
                * (root.asDiagonal() * G.partialPivLu().solve(H)
                   * root.cwiseInverse().asDiagonal());
          const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> eigen(
              0.5 * (Z + Z.adjoint()), Eigen::EigenvaluesOnly);
          expected[std::arg(w)]
              = eigen.eigenvalues()(0) / (medium.density * medium.c2);
        },
        boundary, medium, kernel.time_step(), 30, 0.97);
    ASSERT_EQ(report.eigenvalues.size(), expected.size());
    EXPECT_TRUE(
        std::is_sorted(report.frequencies.begin(), report.frequencies.end()));
    std::size_t k = 0;
    for (const auto &[angle, eigenvalue] : expected)
    {
      EXPECT_NEAR(report.frequencies[k] * 2. * M_PI * kernel.time_step(), angle,
                  1e-12);
      EXPECT_NEAR(report.eigenvalues[k], eigenvalue,
                  1e-3 * std::abs(eigenvalue) + 1e-6);
      ++k;
    }
  }
}

// One mode that creates energy around one frequency, because its impedance has
// a pole just outside the unit circle with a residue of the wrong sign.
TEST(Passivity, finds_a_narrow_band)
{
  const double dt = 0.1, angle = 1.27, unit = medium.density * medium.c2;
  const auto pole      = std::polar(1.002, angle);
  const auto transform = [&](const std::complex<double> w, Eigen::MatrixXcd &G,
                             Eigen::MatrixXcd &H)
  {
    G                      = Eigen::MatrixXcd::Identity(32, 32);
    Eigen::VectorXcd scale = Eigen::VectorXcd::Ones(32);
    for (unsigned k = 0; k < 32; ++k)
      scale(k) += 0.01 * k;
    scale(7)
        += 0.02 * (pole / (w - pole) + std::conj(pole) / (w - std::conj(pole)));
    H = ((1. - w) * unit / dt * scale).asDiagonal();
  };
  const auto coarse = scan_passivity(transform, circle, medium, dt, 32, 0.99);
  // 1 + 0.07 - 0.02 / 0.012.
  EXPECT_NEAR(coarse.smallest_eigenvalue, -0.6, 0.03);
  EXPECT_NEAR(coarse.frequency, angle / (2. * M_PI * dt), 0.01);
  // None of the equally spaced frequencies is in the band.
  double equally_spaced = 1.;
  for (std::size_t k = 0; k < coarse.frequencies.size(); ++k)
  {
    const double place
        = coarse.frequencies[k] * 2. * dt * 32. - 0.5; // whole if among them
    if (std::abs(place - std::round(place)) < 1e-9)
      equally_spaced = std::min(equally_spaced, coarse.eigenvalues[k]);
  }
  EXPECT_GT(equally_spaced, 0.);
}

TEST(Passivity, refuses_radius)
{
  const ZTransform none;
  EXPECT_THROW(scan_passivity(none, circle, medium, 1., 10, 1.), InputError);
  EXPECT_THROW(scan_passivity(none, circle, medium, 1., 0, 0.9), InputError);
}
