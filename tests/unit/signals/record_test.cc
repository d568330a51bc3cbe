// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/signals/synthetic_record.h>

#include "../base/message_of.h"
#include "../output/temporary_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

using namespace quoin;

namespace
{
  void write(const std::string &path, const std::string &text)
  {
    std::ofstream(path) << text;
  }

  constexpr double g = 9.80665;

  TimeTable samples_of(const std::string &name, const std::string &text)
  {
    const TemporaryDirectory directory;
    write(directory / name, text);
    return Record::read(directory.path() + "/" + name).samples();
  }

  std::string complaint(const std::string &name, const std::string &text)
  {
    return message_of<InputError>([&] { samples_of(name, text); });
  }

  /** It drifts away. */
  Record drifting()
  {
    TimeTable table;
    for (int k = 0; k <= 400; ++k)
      table.emplace_back(0.5 + 0.01 * k, std::sin(0.05 * k) + 0.1);
    return Record(std::move(table));
  }
} // namespace

TEST(Record, ReadsHeadersOfThePeerDatabase)
{
  const std::string head
      = "PEER NGA STRONG MOTION DATABASE RECORD\n"
        "NORTHRIDGE 01/17/94 12:31, ARLETA, 090 (CDMG STATION 24087)\n";
  const std::string values = "   .100000E-02  -.2000E-02\n  0.3 -4.0E-1 5D-1\n";
  for (const std::string line :
       { "ACCELERATION TIME HISTORY IN UNITS OF G\n"
         " NPTS=  5, DT= .02000 SEC\n",
         "ACCELERATION TIME SERIES IN UNITS OF G\n"
         "NPTS=   5, DT=   .0200 SEC,\n",
         "Acceleration time history in units of g\r\n"
         "NPTS= 5 DT= 2.0E-02 SEC\r\n",
         "ACCELERATION (G)\nNPTS= 5, DT= 2.0D-02 SEC\n",
         "UNITS: G  FILTER POINTS: HP=0.1 Hz LP=30.0 Hz\n"
         "   5    0.0200    NPTS, DT\n" })
  {
    const TimeTable table = samples_of("a.at2", head + line + values);
    ASSERT_EQ(table.size(), 5U) << line;
    EXPECT_EQ(table[0].first, 0.);
    EXPECT_NEAR(table[4].first, 0.08, 1e-15);
    EXPECT_NEAR(table[0].second, 1e-3 * g, 1e-15);
    EXPECT_NEAR(table[3].second, -0.4 * g, 1e-15);
    EXPECT_NEAR(table[4].second, 0.5 * g, 1e-15);
  }
  const TimeTable velocity
      = samples_of("A.VT2", head
                                + "VELOCITY TIME SERIES IN UNITS OF CM/S\n"
                                  "NPTS= 2, DT= .01 SEC\n100 -200\n");
  EXPECT_DOUBLE_EQ(velocity[1].second, -2.);
  const TimeTable cm
      = samples_of("a.AT2", head
                                + "ACCELERATION IN UNITS OF CM/SEC/SEC\n"
                                  "NPTS= 2, DT= .01 SEC\n100 -200\n");
  EXPECT_DOUBLE_EQ(cm[0].second, 1.);
}

// Headers that do not say 'UNITS OF'; without any word by the kind of file.
TEST(Record, UnitsInOtherWords)
{
  const auto first = [](const std::string &name, const std::string &header)
  {
    return samples_of(name, header + "\nNPTS= 2, DT= .01 SEC\n100 -200\n")[0]
        .second;
  };
  EXPECT_DOUBLE_EQ(first("a.VT2", "VELOCITY (CM/SEC)"), 1.);
  EXPECT_DOUBLE_EQ(first("a.AT2", "ACCELERATION, CM/S/S"), 1.);
  EXPECT_DOUBLE_EQ(first("a.VT2", "VELOCITY (M/SEC)"), 100.);
  EXPECT_DOUBLE_EQ(first("a.AT2", "ACCELERATION (G)"), 100. * g);
  EXPECT_DOUBLE_EQ(first("a.AT2", "ACCELERATION"), 100. * g);
  EXPECT_DOUBLE_EQ(first("a.VT2", "VELOCITY"), 1.);
}

TEST(Record, RefusesBrokenFiles)
{
  const auto expect = [](const std::string &message, const std::string &part)
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("a.at2"), std::string::npos) << message;
  };
  expect(complaint("a.at2", "no\nheader\n1 2 3\n"), "NPTS");
  expect(complaint("a.at2", "NPTS= 4, DT= .01 SEC\n1 2 3\n"),
         "ends after 3 of 4 values");
  expect(complaint("a.at2", "NPTS= 4, DT= .01 SEC\n1 2 x 4\n"), "'x'");
  expect(complaint("a.at2", "IN UNITS OF MM/S/S\nNPTS= 1, DT= 1 SEC\n1\n"),
         "NPTS");
  expect(complaint("a.at2", "IN UNITS OF MM/S/S\nNPTS= 2, DT= 1 SEC\n1 2\n"),
         "'MM'");
  expect(complaint("a.at2", "NPTS= 4, DT= 0 SEC\n1 2 3 4\n"), "NPTS");
  EXPECT_THROW(Record(TimeTable{ { 0., 1. } }), InputError);
}

TEST(Record, BaselineCorrections)
{
  Record record = drifting();
  EXPECT_GT(std::abs(record.final_integral()), 0.1);
  record.correct(Baseline::linear);
  EXPECT_NEAR(record.final_integral(), 0., 1e-13);
  EXPECT_GT(std::abs(record.final_second_integral()), 0.1);
  record = drifting();
  record.correct(Baseline::quadratic);
  EXPECT_NEAR(record.final_integral(), 0., 1e-13);
  EXPECT_NEAR(record.final_second_integral(), 0., 1e-13);
  const Signal signal = record.signal();
  EXPECT_NEAR(signal.integral(100.), 0., 1e-13);
  EXPECT_NEAR(signal.second_integral(100.), 0., 1e-11);
}

TEST(Record, TaperFadesBothEnds)
{
  Record record = drifting();
  record.taper(0.1);
  EXPECT_EQ(record.samples().front().second, 0.);
  EXPECT_NEAR(record.samples().back().second, 0., 1e-15);
  EXPECT_NEAR(record.samples()[20].second, 0.5 * (std::sin(1.) + 0.1), 1e-12);
  EXPECT_EQ(record.samples()[200].second, drifting().samples()[200].second);
}

TEST(Record, IntegralsAreThoseOfLinearAcceleration)
{
  const Signal signal = drifting().signal();
  EXPECT_EQ(signal.value(0.499), 0.);
  EXPECT_EQ(signal.integral(0.4), 0.);
  EXPECT_EQ(signal.value(4.51), 0.);
  const double h = 1e-5;
  for (double t = 0.5003; t < 4.6; t += 0.0707)
  {
    EXPECT_NEAR((signal.integral(t + h) - signal.integral(t - h)) / (2. * h),
                signal.value(t), 1e-4);
    EXPECT_NEAR((signal.second_integral(t + h) - signal.second_integral(t - h))
                    / (2. * h),
                signal.integral(t), 1e-7);
  }
}

TEST(SyntheticRecord, HasItsPeakAndEndsAtRest)
{
  for (const Envelope envelope :
       { Envelope::saragoni_hart, Envelope::trapezoidal })
    for (std::uint64_t seed = 1; seed < 6; ++seed)
    {
      SyntheticRecordParameters parameters;
      parameters.peak     = 3.;
      parameters.envelope = envelope;
      parameters.seed     = seed;
      const Record record = synthetic_record(parameters);
      EXPECT_EQ(record.samples().size(), 2001U);
      EXPECT_NEAR(record.peak(), 3., 1e-14);
      EXPECT_NEAR(record.final_integral(), 0., 1e-12);
      EXPECT_NEAR(record.final_second_integral(), 0., 1e-11);
    }
}

TEST(SyntheticRecord, HasItsAriasIntensity)
{
  SyntheticRecordParameters parameters;
  parameters.arias    = 1.5;
  const Record record = synthetic_record(parameters);
  double sum          = 0.;
  for (const auto &[time, value] : record.samples())
    sum += value * value * parameters.step;
  EXPECT_NEAR(0.5 * M_PI / g * sum, 1.5, 1e-12);
}

TEST(SyntheticRecord, RefusesAHighPassThatCannotBe)
{
  for (const double frequency : { 1e-9, 20. })
  {
    SyntheticRecordParameters parameters;
    parameters.low_frequency = frequency;
    EXPECT_NE(message_of<InputError>([&] { synthetic_record(parameters); })
                  .find("high-pass"),
              std::string::npos)
        << frequency;
  }
}

TEST(SyntheticRecord, SeedsAreReproducible)
{
  SyntheticRecordParameters parameters;
  const TimeTable first = synthetic_record(parameters).samples();
  EXPECT_EQ(first, synthetic_record(parameters).samples());
  parameters.seed = 2;
  EXPECT_NE(first, synthetic_record(parameters).samples());
}

TEST(SyntheticRecord, SpectrumIsThatOfKanaiTajimiAndCloughPenzien)
{
  // The mean over seeds of the squared Fourier amplitude, by the density.
  SyntheticRecordParameters parameters;
  parameters.frequency     = 3.;
  parameters.damping       = 0.2;
  parameters.low_frequency = 0.5;
  parameters.arias         = 1.;
  const std::vector<double> frequencies{
    0.5, 1., 2., 2.5, 3., 3.5, 5., 8., 12.
  };
  std::vector<double> power(frequencies.size(), 0.);
  const unsigned int n_seeds = 400;
  for (parameters.seed = 1; parameters.seed <= n_seeds; ++parameters.seed)
  {
    const Record record = synthetic_record(parameters);
    for (std::size_t k = 0; k < frequencies.size(); ++k)
    {
      // By rotation: exp(-i w t) of one sample after the other.
      const std::complex<double> turn
          = std::polar(1., -2. * M_PI * frequencies[k] * parameters.step);
      std::complex<double> sum = 0., phase = 1.;
      for (const auto &[time, value] : record.samples())
      {
        sum += value * phase;
        phase *= turn;
      }
      power[k] += std::norm(sum);
    }
  }
  const auto density = [&](const double frequency)
  {
    const double x = std::pow(frequency / parameters.frequency, 2);
    const double y = std::pow(frequency / parameters.low_frequency, 2);
    const double z = 4. * parameters.damping * parameters.damping;
    const double l = 4. * parameters.low_damping * parameters.low_damping;
    return (1. + z * x) / (std::pow(1. - x, 2) + z * x) * y * y
           / (std::pow(1. - y, 2) + l * y);
  };
  const std::size_t at_ground = 4;
  for (std::size_t k = 0; k < frequencies.size(); ++k)
  {
    // The mean scatters by 5 %; a constant during each step lowers high
    // frequencies, the envelope smooths.
    const double wanted = density(frequencies[k]) / density(3.);
    EXPECT_NEAR(power[k] / power[at_ground] / wanted, 1., 0.25)
        << frequencies[k];
    EXPECT_LE(power[k], 1.1 * power[at_ground]) << frequencies[k];
  }
}

TEST(Record, HeadersBeyondAllNumbersAreRefused)
{
  const std::string values = "\n 1 2 3 4 5\n";
  for (const std::string &line :
       { std::string("NPTS= 5, DT= 1E999 SEC"),
         // Regular expressions would take a stack of this depth.
         "NPTS= 5, DT= " + std::string(1000000, '1'),
         std::string(1000000, ' ') })
    EXPECT_NE(complaint("a.AT2", line + values).find("no header"),
              std::string::npos)
        << complaint("a.AT2", line + values);
}
