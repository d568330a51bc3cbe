// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/signals/signal_frequency.h>
#include <quoin/signals/signal.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace quoin;

namespace
{
  constexpr unsigned int n = 4097;

  double frequency(const FunctionOfTime &function, const double duration)
  {
    return highest_frequency(sampled(function, duration, n),
                             duration / (n - 1));
  }
} // namespace

TEST(SignalFrequency, OfARickerWavelet)
{
  // The energy of its spectrum, f^4 exp(-2 f^2 / f0^2), is a chi-squared
  // distribution with five degrees of freedom of 4 f^2 / f0^2, whose quantile
  // of 99 % is 15.086.
  const double f0 = 20.;
  EXPECT_NEAR(frequency(ricker_wavelet(f0, 0.2).value, 1.),
              0.5 * std::sqrt(15.086) * f0, 1.);
  // It does not matter how long nothing happens afterwards.
  EXPECT_NEAR(frequency(ricker_wavelet(f0, 0.2).value, 5.),
              0.5 * std::sqrt(15.086) * f0, 0.2);
}

TEST(SignalFrequency, OfASine)
{
  const auto sine
      = [](const double t) { return std::sin(2. * M_PI * 50. * t); };
  EXPECT_NEAR(frequency(sine, 1.), 50., 3.);
  // Cut off within a cycle.
  EXPECT_NEAR(frequency(sine, 0.505), 50., 6.);
}

TEST(SignalFrequency, OfADisplacementByItsVelocity)
{
  // The energy of the velocity of exp(-(t/w)^2), f^2 exp(-2 (pi f w)^2), is a
  // chi-squared distribution with three degrees of freedom of (2 pi f w)^2,
  // whose quantile of 99 % is 11.345.
  const double w        = 0.02;
  const double interval = 2. / (n - 1);
  const auto samples
      = sampled([&](const double t)
                { return std::exp(-(t - 0.5) * (t - 0.5) / (w * w)); },
                2., n);
  EXPECT_NEAR(highest_frequency(derivative(samples, interval), interval),
              std::sqrt(11.345) / (2. * M_PI * w), 0.5);
}

TEST(SignalFrequency, WhatOnlyGrowsHasNone)
{
  EXPECT_EQ(frequency([](const double) { return 3.; }, 2.), 0.);
  EXPECT_EQ(frequency([](const double t) { return 3. + 2. * t; }, 2.), 0.);
  // A ramp that ends, over a tenth of the time.
  EXPECT_LT(frequency([](const double t) { return std::min(t, 0.1); }, 1.), 6.);
}

TEST(SignalFrequency, OfAPulseThatIsMuchShorterThanItsTime)
{
  // 99 % of the energy of sin(pi t/T) for 0 < t < T is below 1.18/T, however
  // long nothing happens afterwards.
  const double pulse = 2e-3;
  for (const double duration : { 0.1, 20. })
    EXPECT_NEAR(velocity_frequency(half_sine_pulse(pulse).value,
                                   SignalKind::velocity, duration),
                1.18 / pulse, 0.02 / pulse);
}

TEST(SignalFrequency, ExtremesOfAPulseThatIsMuchShorterThanItsTime)
{
  const Signal pulse = exponential_pulse(1e-4, 2e-3);
  const auto late = [&](const double t) { return -5. * pulse.value(t - 1.5); };
  const auto [low, high] = extremes(late, 20.);
  EXPECT_NEAR(low, -5., 1e-6);
  EXPECT_EQ(high, 0.);
  const auto ramp = [](const double t) { return std::min(1., t); };
  EXPECT_EQ(extremes(ramp, 4.), (std::array<double, 2>{ { 0., 1. } }));
}

TEST(SignalFrequency, IntegralAndDerivativeAreInverse)
{
  const auto samples = sampled([](const double t) { return t * t; }, 1., 101);
  const auto back    = derivative(integral(samples, 0.01), 0.01);
  ASSERT_EQ(back.size(), 100U);
  for (unsigned int i = 0; i < back.size(); ++i)
    EXPECT_NEAR(back[i], 0.5 * (samples[i] + samples[i + 1]), 1e-12);
}

TEST(SignalFrequency, FindsAJumpAndNoSteepSlope)
{
  const double at = 0.3217;
  const Jump jump = largest_jump(
      [&](const double t) { return std::sin(t) + (t < at ? 0. : 0.5); }, 1.);
  EXPECT_NEAR(jump.height, 0.5, 1e-6);
  EXPECT_NEAR(jump.time, at, 1e-6);
  const Jump slope = largest_jump(
      [](const double t) { return std::tanh(1e4 * (t - 0.5)); }, 1.);
  EXPECT_LT(slope.height, 1e-3);
}
