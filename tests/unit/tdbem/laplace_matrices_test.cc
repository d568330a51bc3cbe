// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/tdbem/laplace_matrices.h>

#include "../elastodynamics/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace quoin;
using Complex = std::complex<double>;
using Point   = dealii::Point<2>;
using Vector  = dealii::Tensor<1, 2>;

namespace
{
  const ElasticMedium medium{ 2., std::sqrt(3.), 1. };

  /** Mean over e (or at its middle) of the integrals over f, by brute force. */
  struct Reference
  {
    Eigen::Matrix2cd U = Eigen::Matrix2cd::Zero();
    Eigen::Matrix2cd P = Eigen::Matrix2cd::Zero();

    Reference(const LaplaceKernels &kernels, const BoundaryElement &e,
              const BoundaryElement &f, const Projection projection)
    {
      const auto inner = [&](const Point &x, const double outer)
      {
        // Cut at the foot of x, where the integrand has its peak.
        const double size = f.length();
        const double foot = (x - f.a) * f.tangent();
        const double cut
            = foot > 0. && foot < size ? foot / size : 0.3819660112501;
        const auto add = [&](const Vector &d, const double weight)
        {
          if (d.norm() < 1e-290)
            return;
          U += outer * weight * kernels.displacement(Point(d));
          P += outer * weight * kernels.traction(Point(d), f.normal());
        };
        const Vector edge = f.b - f.a;
        // From whichever end is nearer, so that small distances keep digits.
        const Vector from_a = f.a - x, from_b = f.b - x;
        test::tanh_sinh(
            0., cut,
            [&](const double t, const double w)
            { add(from_a + t * edge, w * size); },
            1. / 20.);
        test::tanh_sinh(
            0., 1. - cut,
            [&](const double t, const double w)
            { add(from_b - t * edge, w * size); },
            1. / 20.);
      };
      if (projection == Projection::collocation)
      {
        inner(e.middle(), 1.);
        return;
      }
      // Cut where the ends of f are nearest; both halves of a piece from the
      // outside, where the digits are.
      std::vector<double> cuts = { 0., 1. };
      for (const Point &end : { f.a, f.b })
        cuts.push_back(std::min(
            1., std::max(0., ((end - e.a) * e.tangent()) / e.length())));
      std::sort(cuts.begin(), cuts.end());
      for (unsigned piece = 0; piece < 3; ++piece)
      {
        const double begin = cuts[piece], end = cuts[piece + 1];
        const Point start = e.a + begin * (e.b - e.a);
        const Point stop  = end == 1. ? e.b : Point(e.a + end * (e.b - e.a));
        const Vector half = 0.5 * (end - begin) * (e.b - e.a);
        if (end > begin)
          test::tanh_sinh(
              0., 1.,
              [&](const double t, const double w)
              {
                inner(start + t * half, 0.5 * (end - begin) * w);
                inner(Point(stop - t * half), 0.5 * (end - begin) * w);
              },
              1. / 20.);
      }
    }
  };

  /** Pairs of every kind; the first element of each comes first. */
  Boundary pair(const Point &a, const Point &b, const Point &c, const Point &d)
  {
    Boundary boundary;
    boundary.elements = { { a, b }, { c, d } };
    return boundary;
  }

  const Point o(0.3, -0.2), one(1.3, -0.2);
  const std::vector<std::pair<std::string, Boundary>> pairs = {
    { "right angle", pair(o, one, one, { 1.3, 0.8 }) },
    { "collinear, other length", pair(o, one, one, { 1.6, -0.2 }) },
    { "sharp corner", pair(o, one, one, { 0.4, 0.1 }) },
    { "obtuse corner, other length", pair(o, one, { -0.4, 2. }, o) },
    { "narrow slot", pair(o, one, { 1.4, -0.17 }, { 0.2, -0.16 }) },
    { "beside", pair(o, one, { 1.4, 0.1 }, { 1.4, 1. }) },
    { "far", pair(o, one, { 7., 3. }, { 7., 5. }) },
    { "very unequal", pair(o, one, { 1.31, -0.2 }, { 1.31, -0.18 }) },
  };
} // namespace

class LaplaceMatricesOfPair : public testing::TestWithParam<Projection>
{
};

TEST_P(LaplaceMatricesOfPair, agree_with_brute_force)
{
  double worst = 0.;
  const Complex s(0.5, 3.);
  for (const auto &[name, boundary] : pairs)
  {
    const auto matrices = laplace_matrices(boundary, medium, s, GetParam());
    const LaplaceKernels kernels(medium, s);
    for (const unsigned e : { 0u, 1u })
    {
      const unsigned f = 1 - e;
      const Reference reference(kernels, boundary.elements[e],
                                boundary.elements[f], GetParam());
      const double error_G
          = (matrices.G.block<2, 2>(2 * e, 2 * f) - reference.U.transpose())
                .norm();
      const double error_H
          = (matrices.H.block<2, 2>(2 * e, 2 * f) - reference.P.transpose())
                .norm();
      EXPECT_LT(error_G, 1e-11) << name << ' ' << e;
      EXPECT_LT(error_H, 1e-10) << name << ' ' << e;
      worst = std::max({ worst, error_G, error_H });
    }
  }
  RecordProperty("worst_error", testing::PrintToString(worst));
}

INSTANTIATE_TEST_SUITE_P(Both, LaplaceMatricesOfPair,
                         testing::Values(Projection::collocation,
                                         Projection::galerkin));

TEST(LaplaceMatrices, self_integral)
{
  Boundary boundary;
  boundary.elements              = { { { 0.1, 0.2 }, { 0.5, -0.1 } } };
  const BoundaryElement &element = boundary.elements[0];
  for (const Complex s : { Complex(0.02, 0.1), Complex(0.5, 3.), Complex(8.) })
    for (const auto projection :
         { Projection::collocation, Projection::galerkin })
    {
      const LaplaceKernels kernels(medium, s);
      Eigen::Matrix2cd reference = Eigen::Matrix2cd::Zero();
      const bool galerkin        = projection == Projection::galerkin;
      const double reach         = galerkin ? 0.5 : 0.25;
      test::tanh_sinh(0., reach,
                      [&](const double r, const double w)
                      {
                        if (r > 0.)
                          reference += 2. * w * (galerkin ? 1. - r / 0.5 : 1.)
                                       * kernels.displacement(
                                           Point(r * element.tangent()));
                      });
      const auto matrices = laplace_matrices(boundary, medium, s, projection);
      EXPECT_LT((matrices.G - reference).norm(), 1e-13) << s;
      EXPECT_EQ(matrices.H, 0.5 * Eigen::Matrix2cd::Identity());
    }
}

TEST(LaplaceMatrices, are_reciprocal)
{
  const Boundary square = Boundary::polygon(
      { { 0., 0. }, { 2., 0. }, { 2., 1. }, { 0., 1. } }, 0.4, false);
  const auto matrices = laplace_matrices(square, medium, Complex(0.3, 1.),
                                         Projection::galerkin);
  Eigen::VectorXd weights(square.n_unknowns());
  for (unsigned k = 0; k < weights.size(); ++k)
    weights(k) = square.lengths()(k / 2);
  const Eigen::MatrixXcd G = weights.asDiagonal() * matrices.G;
  EXPECT_LT((G - G.transpose()).norm(), 1e-15 * G.norm());
}

// A plane wave e^{k2 x}, which solves the equation inside.
TEST(LaplaceMatrices, hold_for_a_plane_wave_with_damping)
{
  const Complex s(0.2, 0.5);
  const RayleighDamping damping{ 0.3, 0.1 };
  const LaplaceKernels kernels(medium, s, damping);
  const Complex k = kernels.k2(), modulus = medium.mu() * (1. + 0.1 * s);
  for (const auto projection :
       { Projection::collocation, Projection::galerkin })
  {
    double error[2];
    for (const unsigned level : { 0u, 1u })
    {
      const unsigned n        = level == 0 ? 24 : 48;
      const Boundary boundary = Boundary::circle({ 0., 0. }, 1., n, false);
      const auto matrices
          = laplace_matrices(boundary, medium, s, projection, damping);
      // u_y = e^{k x}, p_y = mu k e^{k x} n_x, p_x = mu k e^{k x} n_y
      Eigen::VectorXcd u = Eigen::VectorXcd::Zero(2 * n), p = u;
      for (unsigned e = 0; e < n; ++e)
      {
        const auto &element = boundary.elements[e];
        const Complex value = std::exp(k * element.middle()[0]);
        u(2 * e + 1)        = value;
        p(2 * e)            = modulus * k * value * element.normal()[1];
        p(2 * e + 1)        = modulus * k * value * element.normal()[0];
      }
      error[level] = (matrices.H * u - matrices.G * p).norm() / u.norm();
    }
    EXPECT_LT(error[0], 0.02);
    EXPECT_LT(error[1], 0.6 * error[0]);
  }
}

TEST(LaplaceMatrices, refuse_crossing_elements)
{
  EXPECT_THROW(laplace_matrices(pair(o, one, { 0.8, -1. }, { 0.8, 0.6 }),
                                medium, 1., Projection::collocation),
               InputError);
}

// Nothing but its own element is left of a kernel that decays at once.
TEST(LaplaceMatrices, far_elements_at_high_rates)
{
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 16, true);
  for (const Complex s : { Complex(300., 0.), Complex(200., 200.) })
  {
    const auto matrices
        = laplace_matrices(boundary, medium, s, Projection::galerkin);
    EXPECT_TRUE(matrices.G.allFinite() && matrices.H.allFinite());
    EXPECT_LT(matrices.G.col(0).segment(8, 16).norm(),
              1e-12 * std::abs(matrices.G(0, 0)));
  }
}
