// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/elastodynamics/time_kernels.h>

#include <gtest/gtest.h>

#include <random>

using namespace quoin;
using Eigen::Matrix2d;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2., 2.5, 0.25);

  TimeKernels at(const double time, const dealii::Tensor<1, 2> &distance,
                 const dealii::Tensor<1, 2> &normal
                 = dealii::Point<2>(0.6, 0.8))
  {
    return time_kernels(medium, time, distance, normal);
  }

  double norm(const Matrix2d &matrix)
  {
    return matrix.cwiseAbs().maxCoeff();
  }
} // namespace

TEST(ElasticMedium, from_young)
{
  const ElasticMedium steel = ElasticMedium::from_young(7850., 210e9, 0.3);
  EXPECT_NEAR(steel.mu(), 210e9 / 2.6, 1.);
  EXPECT_NEAR(steel.lambda(), 210e9 * 0.3 / (1.3 * 0.4), 10.);
  EXPECT_NEAR(steel.poisson(), 0.3, 1e-13);
  EXPECT_NEAR(ElasticMedium::from_young(1., 1., 0.).poisson(), 0., 1e-15);
}

TEST(TimeKernels, are_zero_before_arrival)
{
  const dealii::Point<2> distance(3., -4.);
  EXPECT_EQ(norm(at(5. / medium.c1, distance).A), 0.);
  EXPECT_EQ(norm(at(5. / medium.c1, distance).B), 0.);
  EXPECT_GT(norm(at(5.001 / medium.c1, distance).A), 0.);
  EXPECT_EQ(norm(at(-1., distance).A), 0.);
}

/** A is the time integral of the impulse response. */
TEST(TimeKernels, derivative_is_the_impulse_response)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1., 1.);
  unsigned n_checked = 0;
  for (unsigned k = 0; k < 100; ++k)
  {
    const dealii::Point<2> x(u(random), u(random));
    const double r = x.norm();
    const double T = r / medium.c1 * (1.2 + 2. * std::abs(u(random)));
    const double h = 1e-4 * r;
    const dealii::Tensor<1, 2> e = x / r;
    Matrix2d expected            = Matrix2d::Zero();
    bool near_front              = false;
    for (const double c : { medium.c1, medium.c2 })
    {
      near_front = near_front || std::abs(c * T - r) < 0.1 * r;
      if (c * T < r)
        continue;
      const double R = std::sqrt(T * T - r * r / (c * c));
      const double s = c == medium.c1 ? 1. : -1.;
      expected += (s * (2. * dyad(e, e) - Matrix2d::Identity())
                       * (R + T * T / R) / (r * r)
                   + Matrix2d::Identity() / (c * c * R))
                  / (4. * M_PI * medium.density);
    }
    if (near_front)
      continue;
    ++n_checked;
    const Matrix2d derivative = (8. * (at(T + h, x).A - at(T - h, x).A)
                                 - (at(T + 2. * h, x).A - at(T - 2. * h, x).A))
                                / (12. * h);
    EXPECT_LT(norm(derivative - expected), 1e-9 * norm(expected));
  }
  EXPECT_GT(n_checked, 60u);
}

/** Hooke's law: dB/dT is the traction of A. */
TEST(TimeKernels, tractions_belong_to_the_displacements)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1., 1.);
  unsigned n_checked = 0;
  for (unsigned k = 0; k < 200; ++k)
  {
    const dealii::Point<2> x(u(random), u(random));
    const double r     = x.norm();
    const double angle = 4. * u(random);
    const dealii::Point<2> n(std::cos(angle), std::sin(angle));
    const double T = r / medium.c1 * (1. + 4. * std::abs(u(random)));
    if (std::abs(medium.c1 * T - r) < 0.1 * r
        || std::abs(medium.c2 * T - r) < 0.1 * r)
      continue;
    ++n_checked;

    const double h = 1e-4 * r;
    Matrix2d gradient[2]; // derivative of A in direction k
    for (unsigned i = 0; i < 2; ++i)
    {
      const dealii::Tensor<1, 2> step = h * dealii::Point<2>::unit_vector(i);
      gradient[i] = (8. * (at(T, x + step).A - at(T, x - step).A)
                     - (at(T, x + 2. * step).A - at(T, x - 2. * step).A))
                    / (12. * h);
    }
    Matrix2d traction;
    for (unsigned j = 0; j < 2; ++j)
      for (unsigned i = 0; i < 2; ++i)
      {
        traction(i, j)
            = medium.lambda() * n[i] * (gradient[0](0, j) + gradient[1](1, j));
        for (unsigned l = 0; l < 2; ++l)
          traction(i, j)
              += medium.mu() * n[l] * (gradient[l](i, j) + gradient[i](l, j));
      }
    const Matrix2d derivative
        = (8. * (at(T + h, x, n).B - at(T - h, x, n).B)
           - (at(T + 2. * h, x, n).B - at(T - 2. * h, x, n).B))
          / (12. * h);
    EXPECT_LT(norm(derivative - traction), 1e-8 * norm(traction));
  }
  EXPECT_GT(n_checked, 120u);
}

TEST(TimeKernels, static_limit)
{
  const dealii::Point<2> x(0.3, -0.5), n(0.6, 0.8);
  const Matrix2d expected = static_traction_kernel(medium, x, n);
  const double T          = 1e6;
  EXPECT_LT(norm(at(T, x, n).B / T - expected), 1e-11 * norm(expected));

  // Kelvin's displacements but for a rigid motion: their difference between
  // two points.
  const auto kelvin = [](const dealii::Tensor<1, 2> &y) -> Matrix2d
  {
    const double nu              = medium.poisson();
    const dealii::Tensor<1, 2> e = y / y.norm();
    return ((4. * nu - 3.) * std::log(y.norm()) * Matrix2d::Identity()
            + dyad(e, e))
           / (8. * M_PI * medium.mu() * (1. - nu));
  };
  const dealii::Point<2> y(2., 1.);
  const Matrix2d difference = kelvin(y) - kelvin(x);
  EXPECT_LT(norm(at(T, y).A - at(T, x).A - difference),
            1e-11 * norm(difference));
}
