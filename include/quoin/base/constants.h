// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_constants_h
#define quoin_base_constants_h

#include <cmath>

namespace quoin
{
  /** Constants, in a namespace because tests have local variables of these
      names. */
  namespace constants
  {
    constexpr double pi      = 3.14159265358979323846;
    constexpr double degree  = pi / 180.; /**< [rad] */
    constexpr double gravity = 9.80665;   /**< standard [m/s^2] */
  }                                       // namespace constants

  /** tan of @p angle [degrees], the unit of friction and dilation angles. */
  inline double tangent_of_degrees(const double angle)
  {
    return std::tan(angle * constants::pi / 180.);
  }
} // namespace quoin

#endif
