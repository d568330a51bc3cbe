// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_distribution_h
#define quoin_rock_distribution_h

#include <quoin/rock/random_stream.h>

#include <string>

namespace quoin
{
  /** Statistical distribution of a property of joints. */
  enum class DistributionKind
  {
    constant,
    uniform,
    normal,
    log_normal,
    exponential, /**< the deviation is the mean */
    von_mises    /**< distribution of angles: Fisher's in two dimensions */
  };

  /**
   * A distribution with its mean and its standard deviation, both of the
   * property itself, also where it is log-normal. Angles are in degrees; the
   * deviation s of a von Mises distribution is the circular one, exp(-s^2/2) =
   * I1(kappa)/I0(kappa) with s in radians (@cite MardiaJupp2000).
   */
  struct Distribution
  {
    DistributionKind kind = DistributionKind::constant;
    double mean           = 0.;
    double deviation      = 0.;

    double draw(RandomStream &random) const;

    /** Share of the values that are not positive. */
    double share_below_zero() const;

    /**
     * "3", "uniform 3, 0.5", "normal 3, 0.5", "log-normal 3, 0.5",
     * "exponential 3", "Fisher 30, 5". Throws std::invalid_argument with what
     * is wrong, for the end of a sentence that begins with the parameter.
     */
    static Distribution parse(const std::string &text);
  };

  /** kappa whose von Mises distribution has the circular deviation [rad]. */
  double von_mises_concentration(double deviation);
} // namespace quoin

#endif
