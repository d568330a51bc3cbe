// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/elastodynamics/rayleigh_wave.h>

#include "field_checks.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2000., 3e7, 0.25);
  /** Its frequencies are about 5 Hz, a wave length about 13 m. */
  const SignalRange range{ -0.5, 2.5, 0.002 };

  double wavelet(const double t)
  {
    const double a = std::pow(M_PI * 5. * (t - 1.), 2);
    return (1. - 2. * a) * std::exp(-a);
  }
} // namespace

TEST(RayleighWave, Speed)
{
  EXPECT_NEAR(rayleigh_speed(medium) / medium.c2, 0.9194016868, 1e-10);
  // In closed form for Poisson's ratio 0.
  const ElasticMedium cork = ElasticMedium::from_young(2000., 3e7, 0.);
  EXPECT_NEAR(rayleigh_speed(cork) / cork.c2, std::sqrt(3. - std::sqrt(5.)),
              1e-12);
}

TEST(RayleighWave, VerticalDisplacementOfTheSurfaceIsTheSignal)
{
  const double speed = rayleigh_speed(medium);
  for (const bool to_right : { true, false })
  {
    const RayleighWave wave(medium, to_right, wavelet, range);
    for (const double x : { -20., 0., 15. })
      for (const double t : { 0.8, 1., 1.13 })
        EXPECT_NEAR(wave.displacement({ x, 0. }, t)[1],
                    wavelet(t - (to_right ? x : -x) / speed), 1e-12);
  }
}

TEST(RayleighWave, ParticlesMoveBackwardsOnEllipses)
{
  // The ratio of the axes is 0.6812 for Poisson's ratio 1/4. On a crest of a
  // wave to +x the surface moves to -x.
  const auto cosine = [](const double t)
  { return std::exp(-std::pow((t - 1.) / 0.2, 2)) * std::cos(31. * (t - 1.)); };
  const RayleighWave wave(medium, true, cosine, range);
  const double quarter = 0.5 * M_PI / 31.;
  const auto crest     = wave.displacement({ 0., 0. }, 1.);
  const auto after     = wave.displacement({ 0., 0. }, 1. + quarter);
  EXPECT_NEAR(crest[0], 0., 1e-6);
  EXPECT_GT(crest[1], 0.99);
  EXPECT_LT(after[0], 0.);
  EXPECT_NEAR(-after[0] / std::exp(-std::pow(quarter / 0.2, 2)), 0.6812, 5e-3);
  const RayleighWave back(medium, false, cosine, range);
  EXPECT_NEAR(back.displacement({ 0., 0. }, 1. + quarter)[0], -after[0], 1e-12);
}

TEST(RayleighWave, SurfaceIsTractionFree)
{
  const RayleighWave wave(medium, true, wavelet, range);
  const double scale
      = wave.mean_traction({ 0., -1. }, dealii::Point<2>(1., 0.), 1.02, 1.021)
            .norm();
  for (const double x : { -10., 0., 7. })
    for (double t = 0.7; t < 1.4; t += 0.05)
      EXPECT_LT(
          wave.mean_traction({ x, 0. }, dealii::Point<2>(0., 1.), t, t + 1e-3)
              .norm(),
          1e-9 * scale);
}

TEST(RayleighWave, SatisfiesTheEquationOfMotion)
{
  for (const bool to_right : { true, false })
  {
    const RayleighWave wave(medium, to_right, wavelet, range);
    for (const double y : { -0.5, -3., -10. })
      EXPECT_LT(motion_residual(wave, medium, { 1.5, y }, 1.03, 0.05, 1e-3),
                1e-3)
          << y;
  }
}

TEST(RayleighWave, TractionsAreThoseOfTheDisplacements)
{
  const RayleighWave wave(medium, true, wavelet, range);
  for (const double y : { -0.5, -3., -10. })
    EXPECT_LT(traction_residual(wave, medium, { 1.5, y },
                                dealii::Point<2>(0.6, 0.8), 1.01, 1.02, 3e-3),
              1e-5);
}

TEST(RayleighWave, HasPrecursors)
{
  EXPECT_TRUE(RayleighWave(medium, true, wavelet, range).has_precursors());
}
