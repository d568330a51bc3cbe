// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/rock/distribution.h>

#include <deal.II/base/utilities.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

namespace quoin
{
  namespace
  {
    using constants::degree;
    /** Beyond it a von Mises distribution is a normal one, to 1e-4. */
    constexpr double concentrated = 1e4;

    double standard_normal(RandomStream &random)
    {
      return quantile(boost::math::normal(), random.uniform());
    }

    /** Parameters of the normal distribution of the logarithm. */
    std::pair<double, double> of_logarithm(const double mean,
                                           const double deviation)
    {
      const double variance = std::log1p(std::pow(deviation / mean, 2));
      return { std::log(mean) - 0.5 * variance, std::sqrt(variance) };
    }

    /** Angle about 0 [rad], by the rejection of @cite BestFisher1979. */
    double draw_von_mises(const double kappa, RandomStream &random)
    {
      const double tau = 1. + std::sqrt(1. + 4. * kappa * kappa);
      const double rho = (tau - std::sqrt(2. * tau)) / (2. * kappa);
      const double r   = (1. + rho * rho) / (2. * rho);
      for (;;)
      {
        const double z = std::cos(constants::pi * random.uniform());
        const double f = (1. + r * z) / (r + z);
        const double c = kappa * (r - f);
        const double u = random.uniform();
        if (c * (2. - c) > u || std::log(c / u) + 1. >= c)
          return random.uniform() < 0.5 ? -std::acos(f) : std::acos(f);
      }
    }
  } // namespace

  double von_mises_concentration(const double deviation)
  {
    const double wanted = std::exp(-0.5 * deviation * deviation);
    const auto excess   = [&](const double kappa)
    {
      return boost::math::cyl_bessel_i(1, kappa)
                 / boost::math::cyl_bessel_i(0, kappa)
             - wanted;
    };
    // Beyond, Bessel functions overflow and the asymptote is exact enough.
    constexpr double largest = 500.;
    if (excess(largest) < 0.)
      return 1. / (deviation * deviation) + 0.5;
    const auto bracket = boost::math::tools::bisect(
        excess, 1e-9, largest, boost::math::tools::eps_tolerance<double>(40));
    return 0.5 * (bracket.first + bracket.second);
  }

  double Distribution::draw(RandomStream &random) const
  {
    switch (kind)
    {
    case DistributionKind::constant:
      break;
    case DistributionKind::uniform:
      return mean + std::sqrt(12.) * deviation * (random.uniform() - 0.5);
    case DistributionKind::normal:
      return mean + deviation * standard_normal(random);
    case DistributionKind::log_normal:
    {
      const auto [m, s] = of_logarithm(mean, deviation);
      return std::exp(m + s * standard_normal(random));
    }
    case DistributionKind::exponential:
      return -mean * std::log(random.uniform());
    case DistributionKind::von_mises:
    {
      const double kappa = von_mises_concentration(deviation * degree);
      return kappa > concentrated
                 ? mean + deviation * standard_normal(random)
                 : mean + draw_von_mises(kappa, random) / degree;
    }
    }
    return mean;
  }

  double Distribution::share_below_zero() const
  {
    switch (kind)
    {
    case DistributionKind::uniform:
      return std::max(0., 0.5 - mean / (std::sqrt(12.) * deviation));
    case DistributionKind::normal:
      return cdf(boost::math::normal(mean, deviation), 0.);
    case DistributionKind::constant:
    case DistributionKind::von_mises:
      return mean > 0. ? 0. : 1.;
    case DistributionKind::log_normal:
    case DistributionKind::exponential:
      break;
    }
    return 0.;
  }

  Distribution Distribution::parse(const std::string &text)
  {
    using dealii::Utilities::split_string_list;
    static const std::map<std::string, DistributionKind> words
        = { { "uniform", DistributionKind::uniform },
            { "normal", DistributionKind::normal },
            { "log-normal", DistributionKind::log_normal },
            { "exponential", DistributionKind::exponential },
            { "Fisher", DistributionKind::von_mises } };
    const std::string trimmed = dealii::Utilities::trim(text);
    const auto space          = trimmed.find(' ');
    const auto word           = words.find(trimmed.substr(0, space));

    Distribution result;
    std::vector<double> numbers;
    try
    {
      numbers = dealii::Utilities::string_to_double(split_string_list(
          word == words.end() ? trimmed : trimmed.substr(space + 1), ','));
    }
    catch (const dealii::ExceptionBase &)
    {
      numbers.clear();
    }
    if (word != words.end())
      result.kind = word->second;
    const std::size_t expected
        = result.kind == DistributionKind::constant
                  || result.kind == DistributionKind::exponential
              ? 1
              : 2;
    if (numbers.size() != expected
        || (word != words.end() && space == std::string::npos))
      throw std::invalid_argument(
          "must be a number, 'exponential MEAN', or one of uniform, normal, "
          "log-normal and Fisher with its mean and standard deviation, such "
          "as 'normal 3, 0.5'.");
    result.mean      = numbers[0];
    result.deviation = expected == 2 ? numbers[1] : 0.;
    if (result.deviation < 0. || !std::isfinite(result.mean + result.deviation))
      throw std::invalid_argument(
          "must have a finite mean and a standard deviation that is not "
          "negative.");
    // Bessel functions of nearly no concentration cannot be told apart.
    if (result.kind == DistributionKind::von_mises && result.deviation > 180.)
      throw std::invalid_argument("must not have a standard deviation above "
                                  "180 degrees, where any dip is as likely: "
                                  "take 'uniform'.");
    if (result.deviation == 0. && expected == 2)
      result.kind = DistributionKind::constant;
    if ((result.kind == DistributionKind::log_normal
         || result.kind == DistributionKind::exponential)
        && !(result.mean > 0.))
      throw std::invalid_argument("must have a positive mean.");
    if (result.kind == DistributionKind::exponential)
      result.deviation = result.mean;
    return result;
  }
} // namespace quoin
