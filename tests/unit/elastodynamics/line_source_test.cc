// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/line_source.h>

#include "field_checks.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2500., 2e10, 0.25);
  const dealii::Point<2> position(1., -2.);
  const SignalRange range{ 0., 0.05, 2e-6 };
  constexpr double rise = 4e-3;

  /** Smooth, to 1e6 N. */
  double moment(const double t)
  {
    const double s = std::min(1., std::max(0., t / rise));
    return 1e6 * s * s * s * (10. - 15. * s + 6. * s * s);
  }

  double moment_rate(const double t)
  {
    const double s = t / rise;
    return s > 0. && s < 1. ? 30e6 / rise * s * s * (1. - s) * (1. - s) : 0.;
  }

  const LineSource source(medium, position, moment, range);
} // namespace

TEST(LineSource, TendsToTheStaticSolution)
{
  const dealii::Point<2> x     = position + dealii::Point<2>(0.6, 0.8);
  const dealii::Tensor<1, 2> u = source.displacement(x, 20.);
  const double wanted
      = 1e6 / (2. * M_PI * medium.density * medium.c1 * medium.c1);
  EXPECT_NEAR(u * dealii::Point<2>(0.6, 0.8), wanted, 1e-6 * wanted);
  EXPECT_NEAR(u * dealii::Point<2>(0.8, -0.6), 0., 1e-12 * wanted);
  // Radial and hoop stress are opposite: there is no change of volume.
  const double stress = 2. * medium.mu() * wanted;
  EXPECT_LT((source.mean_traction(x, dealii::Point<2>(0.6, 0.8), 20., 20.001)
             + stress * dealii::Point<2>(0.6, 0.8))
                .norm(),
            1e-6 * stress);
}

TEST(LineSource, IsTheConvolutionOfTheStepSolution)
{
  const double r = 12., travel = r / medium.c1;
  for (const double after : { 0.1 * rise, 0.5 * rise, rise, 3. * rise })
  {
    const double t = travel + after;
    // The step's t / S is integrated over w, t^2 = travel^2 + w^2.
    const GaussRule &rule = gauss_legendre(60);
    const double low      = after > rise
                                ? std::sqrt(std::pow(t - rise, 2) - travel * travel)
                                : 0.;
    const double high     = std::sqrt(t * t - travel * travel);
    double sum            = 0.;
    for (std::size_t g = 0; g < rule.points.size(); ++g)
    {
      const double w = low + rule.points[g] * (high - low);
      sum += rule.weights[g] * (high - low)
             * moment_rate(t - std::sqrt(travel * travel + w * w));
    }
    const double wanted
        = sum / (2. * M_PI * medium.density * medium.c1 * medium.c1 * r);
    const dealii::Tensor<1, 2> u
        = source.displacement(position + dealii::Point<2>(0., r), t);
    // The moment is linear between samples: the error goes with their spacing
    // to the power 3/2.
    const double scale
        = 1e6 / (2. * M_PI * medium.density * medium.c1 * medium.c1 * r);
    EXPECT_NEAR(u[1], wanted, 2e-5 * scale) << after;
    EXPECT_EQ(u[0], 0.);
  }
}

TEST(LineSource, IsZeroBeforeItArrives)
{
  const dealii::Point<2> x = position + dealii::Point<2>(3., 4.);
  const double travel      = 5. / medium.c1;
  EXPECT_EQ(source.displacement(x, 0.999 * travel).norm(), 0.);
  EXPECT_EQ(
      source.mean_traction(x, dealii::Point<2>(1., 0.), 0., 0.999 * travel)
          .norm(),
      0.);
  EXPECT_FALSE(source.has_precursors());
}

TEST(LineSource, SatisfiesTheEquationOfMotion)
{
  for (const double after : { 0.4, 0.7, 1.5 })
    EXPECT_LT(motion_residual(source, medium,
                              position + dealii::Point<2>(9., -12.),
                              15. / medium.c1 + after * rise, 0.05, 5e-5),
              2e-3)
        << after;
}

TEST(LineSource, TractionsAreThoseOfTheDisplacements)
{
  const dealii::Point<2> x = position + dealii::Point<2>(9., -12.);
  const double travel      = 15. / medium.c1;
  for (const double after : { 0.3, 0.7, 1.2, 5. })
  {
    const double t = travel + after * rise;
    EXPECT_LT(traction_residual(source, medium, x, dealii::Point<2>(0.6, 0.8),
                                t, t + 1e-4, 0.01),
              1e-3)
        << after;
  }
}

TEST(LineSource, MomentThatIsSwitchedOn)
{
  // The front of a step is singular, but not its mean.
  const LineSource step(medium, position, [](const double) { return 1e6; },
                        { 0., 0.01, 1e-6 });
  const double r = 5., travel = r / medium.c1, t = 2. * travel;
  const dealii::Point<2> x = position + dealii::Point<2>(r, 0.);
  const double wanted      = 1e6 * t
                        / (2. * M_PI * medium.density * medium.c1 * medium.c1
                           * r * std::sqrt(t * t - travel * travel));
  EXPECT_NEAR(step.displacement(x, t)[0], wanted, 1e-3 * wanted);
  EXPECT_TRUE(std::isfinite(step.mean_traction(x, dealii::Point<2>(1., 0.),
                                               0.999 * travel, 1.001 * travel)
                                .norm()));
}

TEST(LineSource, RefusesAnEmptyRange)
{
  EXPECT_THROW(LineSource(medium, position, moment, SignalRange()), InputError);
}
