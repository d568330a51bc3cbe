// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/laplace_kernels.h>
#include <quoin/elastodynamics/time_kernels.h>

#include "quadrature.h"

#include <gtest/gtest.h>

#include <complex>
#include <vector>

using namespace quoin;
using Complex = std::complex<double>;

namespace
{
  const ElasticMedium medium{ 2., std::sqrt(3.), 1. };

  const dealii::Point<2> normal(std::cos(0.37), std::sin(0.37));

  /** int_0^oo e^{-sT} f(T) dT with f of the time kernels. */
  template <typename Kernel>
  Eigen::Matrix2cd laplace_transform(const Complex s, const double r,
                                     const Kernel &kernel)
  {
    const double arrivals[2] = { r / medium.c1, r / medium.c2 };
    const double last        = arrivals[1] + 40. / s.real();
    Eigen::Matrix2cd sum     = Eigen::Matrix2cd::Zero();
    const auto add           = [&](const double t, const double weight)
    { sum += weight * std::exp(-s * t) * kernel(t); };
    // Square roots at the fronts, smooth but long after the second.
    test::tanh_sinh(arrivals[0], arrivals[1], add);
    for (double begin = arrivals[1]; begin < last;)
    {
      const double end = begin + std::min(begin, 10. / std::abs(s));
      test::tanh_sinh(begin, end, add);
      begin = end;
    }
    return sum;
  }
} // namespace

TEST(LaplaceKernels, are_transforms_of_time_kernels)
{
  for (const Complex s : { Complex(1., 0.), Complex(0.3, 2.), Complex(2., -5.),
                           Complex(0.05, 0.02) })
  {
    const LaplaceKernels kernels(medium, s);
    const dealii::Point<2> d(0.6, -0.35);
    const auto U = laplace_transform(
        s, d.norm(),
        [&](const double t) { return time_kernels(medium, t, d, normal).A; });
    const auto P = laplace_transform(
        s, d.norm(),
        [&](const double t) { return time_kernels(medium, t, d, normal).B; });
    const auto U_hat = kernels.displacement(d);
    const auto P_hat = kernels.traction(d, normal);
    EXPECT_LT((s * U - U_hat).norm(), 1e-12 * U_hat.norm()) << s;
    EXPECT_LT((s * s * P - P_hat).norm(), 1e-12 * P_hat.norm()) << s;
  }
}

TEST(LaplaceKernels, satisfy_damped_equation_of_motion)
{
  const RayleighDamping damping{ 0.7, 0.2 };
  const Complex s(0.8, 1.9);
  const LaplaceKernels kernels(medium, s, damping);
  const dealii::Point<2> d(0.5, 0.4);
  // div sigma from the tractions on the planes of the axes.
  const double h              = 1e-3;
  Eigen::Matrix2cd divergence = Eigen::Matrix2cd::Zero();
  for (const unsigned k : { 0u, 1u })
  {
    const dealii::Tensor<1, 2> e = dealii::Point<2>::unit_vector(k);
    divergence += (8.
                       * (kernels.traction(d + h * e, e)
                          - kernels.traction(d - h * e, e))
                   - kernels.traction(d + 2. * h * e, e)
                   + kernels.traction(d - 2. * h * e, e))
                  / (12. * h);
  }
  const Eigen::Matrix2cd inertia
      = medium.density * (s * s + damping.mass * s) * kernels.displacement(d);
  EXPECT_LT((divergence - inertia).norm(), 1e-9 * inertia.norm());
}

// sigma = (1 + b_K s) C : grad u, so that the traction is consistent.
TEST(LaplaceKernels, traction_is_of_the_damped_stress)
{
  const RayleighDamping damping{ 0.7, 0.2 };
  const Complex s(0.8, 1.9);
  const LaplaceKernels kernels(medium, s, damping);
  const dealii::Point<2> d(0.5, 0.4);
  const double h = 1e-3;
  Eigen::Matrix2cd gradient[2]; // of U, by direction of the derivative
  for (const unsigned k : { 0u, 1u })
  {
    const dealii::Tensor<1, 2> e = dealii::Point<2>::unit_vector(k);
    gradient[k]                  = (8.
                       * (kernels.displacement(d + h * e)
                          - kernels.displacement(d - h * e))
                   - kernels.displacement(d + 2. * h * e)
                   + kernels.displacement(d - 2. * h * e))
                  / (12. * h);
  }
  const Complex viscous = 1. + damping.stiffness * s;
  Eigen::Matrix2cd traction;
  for (const unsigned i : { 0u, 1u })
    for (const unsigned j : { 0u, 1u })
    {
      traction(i, j) = medium.lambda() * normal(i)
                       * (gradient[0](0, j) + gradient[1](1, j));
      for (const unsigned k : { 0u, 1u })
        traction(i, j) += medium.mu() * normal(k)
                          * (gradient[k](i, j) + gradient[i](k, j));
    }
  const Eigen::Matrix2cd expected = kernels.traction(d, normal);
  EXPECT_LT((viscous * traction - expected).norm(), 1e-9 * expected.norm());
}

TEST(LaplaceKernels, static_limit)
{
  const dealii::Point<2> d(0.6, -0.35);
  const double r = d.norm(), s = 1e-7;
  const Eigen::Matrix2d unit   = Eigen::Matrix2d::Identity();
  const dealii::Tensor<1, 2> e = d / r;
  const LaplaceKernels kernels(medium, s);
  EXPECT_LT(
      (kernels.traction(d, normal) - static_traction_kernel(medium, d, normal))
          .norm(),
      1e-11);
  // Kelvin's solution but for a constant that grows like ln(1/s).
  const double nu = medium.poisson();
  const double factor
      = 1. / (8. * 3.14159265358979324 * medium.mu() * (1. - nu));
  const auto kelvin = [&](const double r)
  {
    return Eigen::Matrix2d(
        factor * (-(3. - 4. * nu) * std::log(r) * unit + dyad(e, e)));
  };
  const Eigen::Matrix2cd difference
      = kernels.displacement(d) - kernels.displacement(7. * d);
  EXPECT_LT((difference - (kelvin(r) - kelvin(7. * r))).norm(), 1e-11);
}

TEST(LaplaceKernels, are_real_analytic_and_symmetric)
{
  const dealii::Point<2> d(0.6, -0.35);
  const Complex s(0.3, 2.);
  const RayleighDamping damping{ 0.4, 0.1 };
  const LaplaceKernels kernels(medium, s, damping);
  const LaplaceKernels conjugate(medium, std::conj(s), damping);
  EXPECT_LT(
      (kernels.traction(d, normal).conjugate() - conjugate.traction(d, normal))
          .norm(),
      1e-15);
  const Eigen::Matrix2cd U = kernels.displacement(d);
  EXPECT_LT((U - U.transpose()).norm(), 1e-15);
  EXPECT_LT((U - kernels.displacement(-d)).norm(), 1e-15);
  EXPECT_LT((kernels.traction(-d, normal) + kernels.traction(d, normal)).norm(),
            1e-15);
  EXPECT_THROW(LaplaceKernels(medium, Complex(0., 1.)), InputError);
}
