// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_loading_rate_h
#define quoin_dynamics_loading_rate_h

#include <algorithm>
#include <cmath>

namespace quoin
{
  /** The rate of the loads' clock [-], which kinetic energy slows down. */
  namespace loading_rate
  {
    constexpr double slowest = 1e-4;
    constexpr double start   = 1e-2; /**< of a stage */

    /**
     * The factor of the rate over the next @p n_steps steps. @p share is
     * the kinetic energy by its limit.
     *
     * Steady loading has a kinetic energy that goes with the square of its
     * rate, so the rate aims at half of the limit. It falls quickly, because a
     * joint that fails lets energy go at any rate and the loads had better
     * wait for it, and rises slowly, because waves take their time to tell
     * what a rate does. It changes by a little every step, because a jump in
     * velocity is a blow.
     */
    inline double growth(const double share, const double n_steps)
    {
      constexpr double aim = 0.5, fastest_fall = 0.5, fastest_rise = 1.1;
      const double factor = std::clamp(std::sqrt(aim / std::max(share, 1e-30)),
                                       fastest_fall, fastest_rise);
      return std::pow(factor, 1. / n_steps);
    }

    inline double next(const double rate, const double growth)
    {
      return std::clamp(rate * growth, slowest, 1.);
    }
  } // namespace loading_rate
} // namespace quoin

#endif
