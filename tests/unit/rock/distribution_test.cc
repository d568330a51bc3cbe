// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/rock/distribution.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace quoin;

namespace
{
  struct Moments
  {
    double mean = 0., deviation = 0., skewness = 0.;
  };

  Moments draw_many(const Distribution &distribution, const int n)
  {
    std::vector<double> values;
    Moments m;
    for (int i = 0; i < n; ++i)
    {
      RandomStream random(7, "test", i);
      values.push_back(distribution.draw(random));
      m.mean += values.back() / n;
    }
    for (const double v : values)
      m.deviation += std::pow(v - m.mean, 2) / n;
    m.deviation = std::sqrt(m.deviation);
    for (const double v : values)
      m.skewness += std::pow((v - m.mean) / m.deviation, 3) / n;
    return m;
  }
} // namespace

TEST(Distribution, has_the_mean_deviation_and_skewness_of_its_kind)
{
  constexpr int n = 40000;
  // Skewness in closed form; sampling errors of the mean are s / sqrt(n).
  const double cv = 0.5;
  const struct
  {
    const char *text;
    double mean, deviation, skewness;
  } cases[] = {
    { "uniform 3, 0.5", 3., 0.5, 0. },
    { "normal 3, 0.5", 3., 0.5, 0. },
    { "log-normal 2, 1", 2., 1., (3. + cv * cv) * cv },
    { "exponential 4", 4., 4., 2. },
  };
  for (const auto &c : cases)
  {
    const Moments m = draw_many(Distribution::parse(c.text), n);
    EXPECT_NEAR(m.mean, c.mean, 4. * c.deviation / std::sqrt(n)) << c.text;
    EXPECT_NEAR(m.deviation, c.deviation, 0.03 * c.deviation) << c.text;
    EXPECT_NEAR(m.skewness, c.skewness, 0.05 + 0.15 * c.skewness) << c.text;
  }
}

TEST(Distribution, fisher_has_its_circular_mean_and_deviation)
{
  constexpr int n = 40000;
  for (const double deviation : { 2., 10., 40. })
  {
    const Distribution fisher{ DistributionKind::von_mises, 30., deviation };
    double c = 0., s = 0.;
    for (int i = 0; i < n; ++i)
    {
      RandomStream random(1, "dip", i);
      const double angle = fisher.draw(random) * M_PI / 180.;
      c += std::cos(angle) / n;
      s += std::sin(angle) / n;
    }
    const double found = std::sqrt(-2. * std::log(std::hypot(c, s)));
    EXPECT_NEAR(std::atan2(s, c) * 180. / M_PI, 30.,
                4. * deviation / std::sqrt(n));
    EXPECT_NEAR(found * 180. / M_PI, deviation, 0.02 * deviation);
  }
}

TEST(Distribution, concentration_goes_over_into_that_of_a_normal_one)
{
  // Where the Bessel functions give way to 1 / s^2 + 1 / 2.
  const double s = 1. / std::sqrt(490.);
  EXPECT_NEAR(von_mises_concentration(s), 1. / (s * s) + 0.5, 0.01);
  // Large scatter: I1 / I0 = kappa / 2, at kappa = 0.2 to 0.5 %.
  const double wide = std::sqrt(-2. * std::log(0.1));
  EXPECT_NEAR(von_mises_concentration(wide), 0.2, 2e-3);
}

TEST(Distribution, knows_how_often_it_is_negative)
{
  EXPECT_NEAR(Distribution::parse("normal 2, 1").share_below_zero(), 0.02275,
              1e-5);
  EXPECT_EQ(Distribution::parse("log-normal 2, 9").share_below_zero(), 0.);
  EXPECT_NEAR(Distribution::parse("uniform 0, 1").share_below_zero(), 0.5,
              1e-12);
}

TEST(Distribution, refuses_what_it_is_not)
{
  for (const char *text :
       { "", "normal", "normal 3", "three", "normal 3, -1", "log-normal -1, 1",
         "exponential 0", "uniform 1, 2, 3", "Gauss 1, 2", "normal nan, 1" })
    EXPECT_THROW(Distribution::parse(text), std::invalid_argument) << text;
}

TEST(RandomStream, depends_on_seed_name_and_number_alone)
{
  const auto first = [](const int seed, const char *name, const int number)
  { return RandomStream(seed, name, number).uniform(); };
  EXPECT_EQ(first(1, "a", 2), first(1, "a", 2));
  EXPECT_NE(first(1, "a", 2), first(2, "a", 2));
  EXPECT_NE(first(1, "a", 2), first(1, "b", 2));
  EXPECT_NE(first(1, "a", 2), first(1, "a", -2));
}
