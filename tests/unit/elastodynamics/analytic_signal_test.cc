// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/analytic_signal.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  using Complex = std::complex<double>;

  constexpr double omega = 2. * M_PI * 5.;
  constexpr double width = 8. / omega;
  constexpr double delay = 2.;

  /** Its analytic signal is this at complex times, up to exp(-32). */
  Complex gabor(const Complex &time)
  {
    const Complex t = time - delay;
    return std::exp(-t * t / (2. * width * width) + Complex(0., omega) * t);
  }

  double wavelet(const double t)
  {
    return gabor(t).real();
  }

  /** 20 samples a period. */
  const SignalRange range{ 0., 4., 0.01 };
} // namespace

TEST(AnalyticSignal, HasItsClosedFormOnTheRealAxisAndAbove)
{
  const AnalyticSignal signal(wavelet, range);
  for (const double d :
       { 0., 1e-13, 1e-5, 0.004, 0.013, 0.05, 0.0998, 0.1001, 0.17, 0.4 })
    for (double t = 0.; t < 4.; t += 0.0137)
    {
      const Complex z(t, d);
      EXPECT_LT(std::abs(signal(z) - gabor(z)), 1e-6) << t << " + i " << d;
    }
}

TEST(AnalyticSignal, RealPartOnTheRealAxisIsTheSignal)
{
  const AnalyticSignal signal(wavelet, range);
  EXPECT_EQ(signal(2.003).real(), wavelet(2.003));
  EXPECT_EQ(signal({ 2.003, -1e-15 }).real(), wavelet(2.003));
}

TEST(AnalyticSignal, OutsideOfTheRangeItIsSummed)
{
  const AnalyticSignal signal(wavelet, { 1.7, 2.2, 0.01 });
  // The signal has not faded at either end. Before the range it counts as
  // zero; after it, it is faded out.
  for (const double d : { 0., 0.03 })
    for (const double t : { 1.7, 2.2 })
      EXPECT_LT(
          std::abs(signal(Complex(t - 1e-9, d)) - signal(Complex(t + 1e-9, d))),
          1e-6);
  const AnalyticSignal all(wavelet, range);
  for (const double d : { 0., 0.03 })
    EXPECT_LT(std::abs(all(Complex(-0.5, d))), 1e-6);
}

TEST(AnalyticSignal, SteadyOscillationHasItsHilbertTransform)
{
  // A signal that does not end within the range is faded out after it.
  const auto started = [](const double t)
  {
    const double s = std::min(1., std::max(0., t));
    return s * s * s * (10. - 15. * s + 6. * s * s) * std::cos(omega * t);
  };
  const AnalyticSignal signal(started, { 0., 6., 0.005 });
  for (double t = 2.; t < 6.; t += 0.037)
    EXPECT_NEAR(signal(t).imag(), std::sin(omega * t), 5e-5) << t;
}

TEST(AnalyticSignal, PrecursorFallsAsTheDistanceInTime)
{
  // A signal with an integral: a Gaussian.
  const auto gauss
      = [](const double t) { return std::exp(-100. * (t - 2.) * (t - 2.)); };
  const AnalyticSignal signal(gauss, range);
  const double integral = std::sqrt(M_PI / 100.);
  EXPECT_NEAR(signal(0.).imag(), -integral / (2. * M_PI),
              2e-2 * integral / (2. * M_PI));
}

TEST(AnalyticSignal, RefusesAnEmptyRange)
{
  EXPECT_THROW(AnalyticSignal(wavelet, SignalRange()), InputError);
  EXPECT_THROW(AnalyticSignal(wavelet, { 1., 0., 0.1 }), InputError);
  EXPECT_THROW(AnalyticSignal(wavelet, { 0., 1., 0. }), InputError);
}
