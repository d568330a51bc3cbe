// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_local_damping_h
#define quoin_base_local_damping_h

#include <quoin/base/lane_functions.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  /**
   * Reduction of the velocity of a degree of freedom by local damping [m/s].
   * Cundall's damping force is a share of the unbalanced force, opposite to the
   * velocity. With the velocity of the last half step it would drive modes near
   * the critical step, whose velocity changes sign every step; so it opposes
   * the mean of @p v0 before and @p v1 after the step, at most halving it, and
   * never does positive work.
   *
   * @p strength is the share times |force| dt / m [m/s].
   */
  inline double local_damping_velocity(const double strength, const double v0,
                                       const double v1)
  {
    const double sum = v0 + v1;
    return std::copysign(std::min(strength, 0.5 * std::abs(sum)), sum);
  }

  /** The reduction of velocity of several degrees of freedom at once. */
  template <int lanes>
  QUOIN_INLINE typename Lanes<lanes>::Value
  local_damping_velocity(const typename Lanes<lanes>::Value &strength,
                         const typename Lanes<lanes>::Value &v0,
                         const typename Lanes<lanes>::Value &v1)
  {
    using F                                = LaneFunctions<lanes>;
    const typename Lanes<lanes>::Value sum = v0 + v1;
    const typename Lanes<lanes>::Value size
        = F::minimum(strength, 0.5 * F::absolute(sum));
    return sum < 0. ? -size : size;
  }
} // namespace quoin

#endif
