// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_loading_rate_h
#define quoin_loading_loading_rate_h

#include <algorithm>
#include <cmath>

namespace quoin
{
  /** Automatic loading rate [-], reduced if kinetic energy is high. */
  namespace loading_rate
  {
    constexpr double slowest = 1e-4;
    constexpr double start   = 1e-2; /**< rate at the start of a stage */

    /**
     * The factor by which the rate changes in each of the next @p n_steps
     * steps. @p share is the kinetic energy by its limit.
     *
     * Under steady loading kinetic energy is proportional to the square of the
     * rate; the aim is half of the limit. The rate falls quickly, because a
     * failing joint releases energy at any rate, and rises slowly, because
     * waves need time to respond. It changes a little in every step, because a
     * jump in velocity is an impact.
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
