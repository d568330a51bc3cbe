// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/element_integrals.h>

#include <gtest/gtest.h>

#include <random>

#include "adaptive_quadrature.h"

using namespace quoin;
using Eigen::Matrix2d;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2., 2.5, 0.25);

  double norm(const Matrix2d &matrix)
  {
    return matrix.cwiseAbs().maxCoeff();
  }

  /** By quadrature, cut where the fronts cross the element and at the foot. */
  TimeKernels quadrature(const double time, const double d, const double s1,
                         const double s2, const double tolerance = 1e-13)
  {
    std::vector<double> kinks = { 0. };
    for (const double c : { medium.c1, medium.c2 })
      if (c * time > std::abs(d))
        for (const double sign : { -1., 1. })
          kinks.push_back(sign * std::sqrt((c * time - d) * (c * time + d)));
    return integrate_adaptively(
        [&](const double s)
        {
          return time_kernels(medium, time, dealii::Point<2>(s, d),
                              dealii::Point<2>(0., 1.));
        },
        s1, s2, kinks, tolerance);
  }
} // namespace

TEST(ElementIntegrals, agree_with_quadrature)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1., 1.);
  double worst_A = 0., worst_B = 0.;
  unsigned n_early = 0, n_crossed = 0, n_late = 0;
  for (unsigned k = 0; k < 500; ++k)
  {
    const double middle = 2. * u(random);
    const double half   = 0.05 + std::abs(u(random));
    const double s1 = middle - half, s2 = middle + half;
    const double d    = 1.5 * u(random);
    const double time = 3. * std::abs(u(random)) / medium.c2;

    const TimeKernels exact = local_element_integrals(medium, time, d, s1, s2);
    const TimeKernels expected = quadrature(time, d, s1, s2);
    worst_A                    = std::max(worst_A, norm(exact.A - expected.A));
    worst_B                    = std::max(worst_B, norm(exact.B - expected.B));

    const double near = std::hypot(d, std::max({ 0., s1, -s2 }));
    const double far  = std::hypot(d, std::max(-s1, s2));
    if (medium.c1 * time <= near)
    {
      ++n_early;
      EXPECT_EQ(norm(exact.A), 0.);
      EXPECT_EQ(norm(exact.B), 0.);
    }
    else
      ++(medium.c2 * time < far ? n_crossed : n_late);
  }
  EXPECT_GT(n_early, 40u);
  EXPECT_GT(n_crossed, 100u);
  EXPECT_GT(n_late, 100u);
  EXPECT_LT(worst_A, 1e-12);
  EXPECT_LT(worst_B, 1e-12);
  RecordProperty("worst_A", std::to_string(worst_A));
}

TEST(ElementIntegrals, agree_with_quadrature_close_to_the_element)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-1., 1.);
  double worst_A = 0., worst_B = 0.;
  for (unsigned k = 0; k < 100; ++k)
  {
    const double s1 = u(random), s2 = s1 + 0.1 + std::abs(u(random));
    const double d
        = std::copysign(std::pow(10., -4. - 3. * u(random)), u(random));
    const double time       = 2. * std::abs(u(random));
    const TimeKernels exact = local_element_integrals(medium, time, d, s1, s2);
    const TimeKernels expected = quadrature(time, d, s1, s2, 1e-13);
    worst_A                    = std::max(worst_A, norm(exact.A - expected.A));
    worst_B                    = std::max(worst_B, norm(exact.B - expected.B));
  }
  EXPECT_LT(worst_A, 1e-10);
  EXPECT_LT(worst_B, 1e-10);
}

/** On the element: logarithm and principal value. */
TEST(ElementIntegrals, of_a_source_on_the_element)
{
  for (const double time : { 0.05, 0.3, 1., 5. })
  {
    const double s1 = -0.2, s2 = 0.7;
    const TimeKernels exact = local_element_integrals(medium, time, 0., s1, s2);
    // B is odd along the element, so its principal value is what remains.
    const TimeKernels right = quadrature(time, 0., -s1, s2);
    EXPECT_LT(norm(exact.B - right.B), 1e-12);
    EXPECT_EQ(exact.B(0, 0), 0.);
    EXPECT_EQ(exact.B(1, 1), 0.);
    // Cut off the singularity, whose integral over (0, x) is x times the
    // kernel's value plus x (q_1 + q_2) / (4 pi rho) to leading order.
    const double x          = 1e-8;
    const TimeKernels left  = quadrature(time, 0., s1, -x);
    const TimeKernels other = quadrature(time, 0., x, s2);
    const TimeKernels at_x = time_kernels(medium, time, dealii::Point<2>(x, 0.),
                                          dealii::Point<2>(0., 1.));
    const double q
        = 1. / (medium.c1 * medium.c1) + 1. / (medium.c2 * medium.c2);
    const Matrix2d gap
        = 2. * x
          * (at_x.A + q / (4. * M_PI * medium.density) * Matrix2d::Identity());
    EXPECT_LT(norm(exact.A - left.A - other.A - gap), 1e-12);
  }
}

/** The jump of the double layer gives the free term. */
TEST(ElementIntegrals, jump_across_the_element)
{
  const double time = 0.8, d = 1e-13;
  const TimeKernels below = local_element_integrals(medium, time, d, -0.4, 0.5);
  const TimeKernels on = local_element_integrals(medium, time, 0., -0.4, 0.5);
  const TimeKernels above
      = local_element_integrals(medium, time, -d, -0.4, 0.5);
  const Matrix2d half = 0.5 * time * Matrix2d::Identity();
  EXPECT_LT(norm(below.B - on.B + half), 1e-12);
  EXPECT_LT(norm(above.B - on.B - half), 1e-12);
}

/** Long after, the integrals of the static kernel. */
TEST(ElementIntegrals, static_limit)
{
  const double T          = 1e6;
  const TimeKernels exact = local_element_integrals(medium, T, 0.3, -0.2, 1.);
  const Matrix2d expected
      = integrate_adaptively(
            [](const double s)
            {
              return TimeKernels{ Matrix2d::Zero(),
                                  static_traction_kernel(
                                      medium, dealii::Point<2>(s, 0.3),
                                      dealii::Point<2>(0., 1.)) };
            },
            -0.2, 1., 1e-14)
            .B;
  EXPECT_LT(norm(exact.B / T - expected), 1e-11);
}

/** In a turned and shifted frame, against the point kernels. */
TEST(ElementIntegrals, in_the_global_frame)
{
  const BoundaryElement element{ { 1., 2. }, { 1.3, 1.6 } };
  const dealii::Point<2> source(0.5, 1.7);
  for (const double time : { 0.6, 0.9, 3. })
  {
    const TimeKernels exact = element_integrals(medium, time, source, element);
    TimeKernels expected{ Matrix2d::Zero(), Matrix2d::Zero() };
    const unsigned n = 20000;
    for (unsigned k = 0; k < n; ++k)
    {
      const dealii::Tensor<1, 2> y
          = element.a + (element.b - element.a) * (k + 0.5) / n;
      const TimeKernels value
          = time_kernels(medium, time, y - source, element.normal());
      expected.A += element.length() / n * value.A;
      expected.B += element.length() / n * value.B;
    }
    EXPECT_LT(norm(exact.A - expected.A), 1e-7);
    EXPECT_LT(norm(exact.B - expected.B), 1e-7);
  }
}
