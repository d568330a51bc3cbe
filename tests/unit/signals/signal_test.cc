// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/signals/signal_text.h>

#include "../base/message_of.h"
#include "../output/temporary_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace quoin;

namespace
{
  void write(const std::string &path, const std::string &text)
  {
    std::ofstream(path) << text;
  }

  Signal read(const std::string &text)
  {
    return read_signal(text, "./");
  }

  std::string complaint(const std::string &text)
  {
    return message_of<InputError>([&] { read_signal(text, "./"); });
  }

  /** Derivatives of integrals are what has been integrated. */
  void expect_integrals(const Signal &signal, const double begin,
                        const double end, const std::string &what)
  {
    const double h = 1e-6 * (end - begin);
    for (double t = begin + 0.0123 * (end - begin); t < end;
         t += 0.0371 * (end - begin))
    {
      const double value = signal.value(t);
      EXPECT_NEAR((signal.integral(t + h) - signal.integral(t - h)) / (2. * h),
                  value, 1e-5)
          << what << ' ' << t;
      EXPECT_NEAR(
          (signal.second_integral(t + h) - signal.second_integral(t - h))
              / (2. * h),
          signal.integral(t), 1e-7 * (end - begin))
          << what << ' ' << t;
    }
  }
} // namespace

TEST(Signal, IntegralsInClosedForm)
{
  expect_integrals(read("wavelet Ricker 5 0.3"), 0., 0.6, "Ricker");
  expect_integrals(read("pulse half-sine 0.4 0.1"), 0., 1., "half-sine");
  expect_integrals(read("pulse triangular 0.1 0.5 0.1"), 0., 1., "triangular");
  expect_integrals(read("pulse exponential 0.1 0.5"), 0.01, 3., "exponential");
  expect_integrals(read("pulse Friedlander 0.4 1.5"), 0.01, 3., "Friedlander");
}

TEST(Signal, RickerHasItsPeakAtTheDelay)
{
  EXPECT_EQ(read("wavelet Ricker 5 0.3").value(0.3), 1.);
  EXPECT_EQ(read("wavelet Ricker 5").value(0.3), 1.);
  EXPECT_LT(std::abs(read("wavelet Ricker 5").value(0.)), 1e-7);
}

TEST(Signal, Gabor)
{
  const Signal signal = read("wavelet Gabor 10 0.05 90 0.4");
  const double s      = 0.013;
  EXPECT_NEAR(signal.value(0.4 + s),
              -std::exp(-0.5 * s * s / 0.0025) * std::sin(20. * M_PI * s),
              1e-14);
}

TEST(Signal, Pulses)
{
  const Signal half_sine = read("pulse half-sine 0.4");
  EXPECT_DOUBLE_EQ(half_sine.value(0.2), 1.);
  EXPECT_EQ(half_sine.value(-0.1), 0.);
  EXPECT_EQ(half_sine.value(0.41), 0.);
  EXPECT_NEAR(half_sine.integral(9.), 0.8 / M_PI, 1e-15);

  const Signal triangle = read("pulse triangular 0.1 0.5");
  EXPECT_DOUBLE_EQ(triangle.value(0.1), 1.);
  EXPECT_DOUBLE_EQ(triangle.value(0.05), 0.5);
  EXPECT_DOUBLE_EQ(triangle.value(0.35), 0.5);
  EXPECT_EQ(triangle.value(0.7), 0.);
  EXPECT_NEAR(triangle.integral(5.), 0.3, 1e-14);
}

TEST(Signal, CyclesFollowEachOtherSmoothly)
{
  const Signal signal = read("cycles 0.02 1e-3 5e-3");
  const double first = 2. * M_PI * 1e-3 / 0.02, second = 5. * first;
  EXPECT_EQ(signal.value(-0.1), 0.);
  EXPECT_NEAR(signal.value(0.25 * first), 1e-3, 1e-15);
  EXPECT_NEAR(signal.value(0.75 * first), -1e-3, 1e-15);
  EXPECT_NEAR(signal.value(first + 0.25 * second), 5e-3, 1e-15);
  EXPECT_NEAR(signal.value(first + 0.75 * second), -5e-3, 1e-15);
  EXPECT_EQ(signal.value(1.0001 * (first + second)), 0.);
  // The slope where one cycle passes into the next.
  for (const double t : { 1e-9, first })
    EXPECT_NEAR((signal.value(t + 1e-6) - signal.value(t)) / 1e-6, 0.02, 1e-8);
}

TEST(Signal, FriedlanderPulseChangesSignAtItsDuration)
{
  const Signal signal = read("pulse Friedlander 0.4 1.5 0.1");
  EXPECT_EQ(signal.value(0.1), 0.);
  EXPECT_NEAR(signal.value(0.1 + 1e-12), 1., 1e-10);
  EXPECT_NEAR(signal.value(0.3), 0.5 * std::exp(-0.75), 1e-14);
  EXPECT_NEAR(signal.value(0.5), 0., 1e-14);
  EXPECT_LT(signal.value(0.7), 0.);
  // The impulse of both phases, T (b - 1) / b^2.
  EXPECT_NEAR(signal.integral(50.), 0.4 * 0.5 / 2.25, 1e-12);
}

TEST(Signal, ExponentialPulseHasItsPeakAtTheRiseTime)
{
  for (const double rise : { 1e-6, 1e-4, 3e-3, 0.0099 })
  {
    const Signal signal = exponential_pulse(rise, 0.01);
    EXPECT_NEAR(signal.value(rise), 1., 1e-12);
    EXPECT_LT(signal.value(0.99 * rise), 1.);
    EXPECT_LT(signal.value(1.01 * rise), 1.);
    EXPECT_EQ(signal.value(-1e-9), 0.);
  }
  // The tail falls by e in the decay time.
  const Signal signal = exponential_pulse(1e-3, 0.01);
  EXPECT_NEAR(signal.value(0.11) / signal.value(0.1), std::exp(-1.), 1e-9);
  EXPECT_THROW(exponential_pulse(0.01, 0.01), InputError);
  EXPECT_THROW(exponential_pulse(0., 0.01), InputError);
}

TEST(Signal, NumericalIntegrals)
{
  const Signal known = ricker_wavelet(5., 0.4);
  Signal unknown;
  unknown.value = known.value;
  for (const unsigned int n : { 0U, 1U, 2U })
  {
    const auto closed    = integrated(known, n, 0., 1., 2e-3);
    const auto numerical = integrated(unknown, n, 0., 1., 2e-3);
    // Peaks are about 1, 0.03 and 0.002.
    for (double t = -0.2; t < 1.; t += 0.0173)
      EXPECT_NEAR(numerical(t), closed(t), 1e-7) << n << ' ' << t;
    EXPECT_NEAR(numerical(1.5), closed(1.5), 1e-7);
  }
}

TEST(Signal, RecordsAreIntegratedAndDelayed)
{
  const TemporaryDirectory directory;
  write(directory / "r.csv", "0, 0\n1, 2\n2, 0\n");
  const std::string folder = directory.path() + "/";
  const auto read
      = [&](const std::string &text) { return read_signal(text, folder); };
  EXPECT_DOUBLE_EQ(read("record r.csv").value(0.5), 1.);
  EXPECT_DOUBLE_EQ(read("record r.csv integrated once").value(1.), 1.);
  EXPECT_DOUBLE_EQ(read("record r.csv integrated once delay 1").value(2.), 1.);
  EXPECT_DOUBLE_EQ(read("record r.csv integrated twice").value(1.), 1. / 3.);
  EXPECT_DOUBLE_EQ(read("record r.csv integrated twice").value(3.), 4.);
  EXPECT_NEAR(read("record r.csv baseline linear integrated once").value(2.),
              0., 1e-15);
  EXPECT_NE(read("record r.csv").report.find("r.csv: 3 values"),
            std::string::npos);
}

TEST(Signal, Synthetic)
{
  const Signal a = read("synthetic frequency 3 duration 5 peak 2 seed 7");
  const Signal b = read("synthetic frequency 3 duration 5 peak 2 seed 7");
  const Signal c = read("synthetic frequency 3 duration 5 peak 2 seed 8");
  EXPECT_EQ(a.value(1.23), b.value(1.23));
  EXPECT_NE(a.value(1.23), c.value(1.23));
}

TEST(Signal, OfAnotherMotion)
{
  constexpr int displacement = 0, velocity = 1, acceleration = 2;
  for (const std::string text :
       { "record a.at2", "synthetic frequency 3", "record b/A.AT2 delay 1" })
  {
    EXPECT_EQ(other_motion_text(text, acceleration), "") << text;
    EXPECT_NE(other_motion_text(text, velocity).find("'integrated once'"),
              std::string::npos);
    EXPECT_NE(other_motion_text(text, displacement).find("'integrated twice'"),
              std::string::npos);
    EXPECT_EQ(other_motion_text(text + " integrated once", velocity), "");
    EXPECT_EQ(other_motion_text(text + " integrated twice", displacement), "");
    EXPECT_NE(other_motion_text(text + " integrated once", acceleration)
                  .find("leave out 'integrated'"),
              std::string::npos);
  }
  EXPECT_EQ(other_motion_text("record a.vt2", velocity), "");
  EXPECT_NE(other_motion_text("record a.vt2", acceleration)
                .find("of acceleration, but the file is of velocity"),
            std::string::npos);
  EXPECT_EQ(other_motion_text("record a.dt2 times 2", displacement), "");
  for (const int derivative : { displacement, velocity, acceleration })
    for (const std::string text :
         { "record a.csv", "table a.at2", "wavelet Ricker 5", "3*t" })
      EXPECT_EQ(other_motion_text(text, derivative), "") << text;
}

TEST(Signal, WrongTexts)
{
  const std::vector<std::pair<std::string, std::string>> wrong
      = { { "wavelet", "'wavelet Ricker ...'" },
          { "wavelet Morlet 5", "'wavelet Ricker ...'" },
          { "wavelet Ricker", "must read 'wavelet Ricker FREQUENCY [DELAY]'" },
          { "wavelet Ricker 5 0.3 1", "must read" },
          { "wavelet Ricker fast", "'fast' for FREQUENCY" },
          { "wavelet Ricker -5", "must be positive" },
          { "wavelet Gabor 5 1 0", "must read 'wavelet Gabor" },
          { "pulse square 1", "'pulse half-sine ...'" },
          { "pulse exponential 2 1", "RISE < DECAY" },
          { "pulse Friedlander 1", "DURATION COEFFICIENT" },
          { "cycles 1", "cycles RATE AMPLITUDE" },
          { "cycles 1 0", "AMPLITUDE" },
          { "cycles fast 1", "RATE" },
          { "pulse triangular 0 1", "must be positive" },
          { "record", "must read 'record FILE'" },
          { "record nowhere.csv", "nowhere.csv' cannot be read" },
          { "record nowhere.at2", "nowhere.at2' cannot be read" },
          { "synthetic frequency", "lacks a value after 'frequency'" },
          { "synthetic seed 1 seed 2", "'seed' twice" },
          { "synthetic seed -1", "whole number" },
          { "synthetic colour red", "unknown option 'colour'" },
          { "synthetic peak 1 Arias 2", "both 'peak' and 'Arias'" },
          { "synthetic envelope square", "Saragoni-Hart, trapezoidal" },
          { "synthetic step 0.1", "shorter 'step'" },
          { "synthetic damping 1.5", "between 0 and 1" } };
  for (const auto &[text, part] : wrong)
    EXPECT_NE(complaint(text).find(part), std::string::npos)
        << text << ": " << complaint(text);
}
