// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joints/joint_damping.h>

#include <cmath>

namespace quoin
{
  double restitution_of_damping(const double xi)
  {
    // Near critical damping arccos(xi)/sqrt(1 - xi^2) is 1 + (1 - xi)/3.
    const double squared = 1. - xi * xi;
    const double ratio   = std::abs(squared) < 1e-8 ? 1. + (1. - xi) / 3.
                           : squared > 0. ? std::acos(xi) / std::sqrt(squared)
                                          : std::acosh(xi) / std::sqrt(-squared);
    return std::exp(-2. * xi * ratio);
  }

  double damping_of_restitution(const double restitution)
  {
    if (restitution == 1.)
      return 0.;
    double low = 0., high = 1.;
    while (restitution_of_damping(high) > restitution)
      high *= 2.;
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double middle = 0.5 * (low + high);
      (restitution_of_damping(middle) > restitution ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
} // namespace quoin
