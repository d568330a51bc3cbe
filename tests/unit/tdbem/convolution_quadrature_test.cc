// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/tdbem/convolution_quadrature.h>

#include "cavity.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  const ElasticMedium medium{ 2., std::sqrt(3.), 1. };

  struct Errors
  {
    double all, late; /**< largest, of the peak; late: from c1 t = 3 a on */
  };

  Errors cavity_errors(const Projection projection, const double beta,
                       const RayleighDamping &damping = RayleighDamping())
  {
    const Boundary boundary = test::cavity(1., 32);
    const double time_step  = beta * boundary.elements[0].length() / medium.c1;
    const unsigned n_steps  = unsigned(8. / (medium.c1 * time_step));
    const ConvolutionQuadrature kernel(boundary, medium, time_step, n_steps,
                                       projection, damping);
    const Eigen::MatrixXd u
        = test::step_response(kernel, test::unit_pressure(boundary), n_steps);
    Errors errors{ 0., 0. };
    for (unsigned step = 0; step < n_steps; ++step)
    {
      const double time = (step + 1) * time_step;
      const double exact
          = test::cavity_wall_displacement(medium, 1., time, damping);
      const double error
          = std::abs(2. * medium.mu()
                         * test::radial_displacement(boundary, u.col(step))
                     - exact)
            / 1.1914401312;
      errors.all = std::max(errors.all, error);
      if (medium.c1 * time > 3.)
        errors.late = std::max(errors.late, error);
    }
    return errors;
  }
} // namespace

TEST(ConvolutionQuadrature, power_series)
{
  // 1 / (1 - w) and sqrt(1 - w), whose coefficients obey a recursion.
  const unsigned n  = 200;
  const auto series = power_series_coefficients(
      n, 2,
      [](const std::complex<double> w, Eigen::VectorXcd &values)
      { values << 1. / (1. - w), std::sqrt(1. - w); });
  double root = 1.;
  for (unsigned k = 0; k < n; ++k)
  {
    EXPECT_NEAR(series(0, k), 1., 1e-8);
    EXPECT_NEAR(series(1, k), root, 1e-10);
    root *= (k - 0.5) / (k + 1.);
  }
}

TEST(ConvolutionQuadrature, weights_do_not_depend_on_how_many_there_are)
{
  const Boundary boundary = test::cavity(1., 8);
  const ConvolutionQuadrature some(boundary, medium, 0.3, 20,
                                   Projection::galerkin);
  const ConvolutionQuadrature more(boundary, medium, 0.3, 50,
                                   Projection::galerkin);
  Eigen::MatrixXd G, H, G_more, H_more, G0, H0;
  some.lag(0, G0, H0);
  for (unsigned n = 0; n < 20; ++n)
  {
    some.lag(n, G, H);
    more.lag(n, G_more, H_more);
    EXPECT_LT((G - G_more).norm(), 1e-9 * G0.norm());
    EXPECT_LT((H - H_more).norm(), 1e-9 * H0.norm());
  }
  EXPECT_THROW(some.lag(20, G, H), std::out_of_range);
  EXPECT_THROW(
      ConvolutionQuadrature(boundary, medium, 0., 5, Projection::galerkin),
      InputError);
}

// Early errors are those of the jump of the load, first order in the step.
TEST(ConvolutionQuadrature, pressurised_cavity_collocation)
{
  const Errors errors = cavity_errors(Projection::collocation, 2.);
  EXPECT_LT(errors.all, 0.087);
  EXPECT_LT(errors.late, 0.045);
}

TEST(ConvolutionQuadrature, pressurised_cavity_galerkin)
{
  const Errors coarse = cavity_errors(Projection::galerkin, 2.);
  EXPECT_LT(coarse.all, 0.093);
  EXPECT_LT(coarse.late, 0.021);
  const Errors fine = cavity_errors(Projection::galerkin, 1.);
  EXPECT_LT(fine.all, 0.051);
  EXPECT_LT(fine.late, 0.008);
}

TEST(ConvolutionQuadrature, pressurised_cavity_with_damping)
{
  // 10 % and more of critical at the frequency c_1 / a.
  for (const RayleighDamping damping :
       { RayleighDamping{ 0.5, 0. }, RayleighDamping{ 0., 0.1 } })
  {
    // The damping changes the response by much more than the errors allowed.
    double change = 0.;
    for (double time = 2.; time < 5.; time += 1.)
      change = std::max(
          change,
          std::abs(test::cavity_wall_displacement(medium, 1., time, damping)
                   - test::cavity_wall_displacement(medium, 1., time)));
    EXPECT_GT(change, 0.03);
    const Errors errors = cavity_errors(Projection::galerkin, 1., damping);
    EXPECT_LT(errors.all, 0.05);
    EXPECT_LT(errors.late, 0.01);
  }
}
