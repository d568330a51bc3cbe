// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_local_damping_h
#define quoin_base_local_damping_h

#include <algorithm>
#include <cmath>

namespace quoin
{
  /**
   * What local damping takes off the velocity that a freedom would reach.
   * Cundall's damping force is a share of the unbalanced force against the
   * velocity. Against that of the half step before it would drive modes near
   * the critical step, whose velocity changes sign every step; so it acts
   * against the mean of @p v0 before and @p v1 after the step, at most
   * halving it, and never does positive work.
   *
   * @p strength is the share times |force| dt / m [m/s].
   */
  inline double local_damping_velocity(const double strength, const double v0,
                                       const double v1)
  {
    const double sum = v0 + v1;
    return std::copysign(std::min(strength, 0.5 * std::abs(sum)), sum);
  }
} // namespace quoin

#endif
