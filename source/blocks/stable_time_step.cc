// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/stable_time_step.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  StableTimeStep::StableTimeStep(
      const std::vector<std::array<double, 3>> &bound)
  {
    for (const auto &[xx, yy, xy] : bound)
      eigenvalue.push_back(0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy));
  }

  double StableTimeStep::largest_eigenvalue(
      const std::vector<double> &mass,
      const std::vector<double> &rigid_factors) const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < eigenvalue.size(); ++i)
      largest = std::max(largest, eigenvalue[i] / mass[i]);
    for (unsigned int b = 0; b < rigid_eigenvalue.size(); ++b)
      largest = std::max(largest,
                         rigid_eigenvalue[b]
                             / (rigid_factors.empty() ? 1. : rigid_factors[b]));
    return largest;
  }

  double StableTimeStep::critical(const double largest_eigenvalue,
                                  const double beta)
  {
    const double omega = std::sqrt(largest_eigenvalue);
    const double xi    = 0.5 * beta * omega;
    // sqrt(1 + xi^2) - xi without cancellation.
    return 2. / omega / (std::sqrt(1. + xi * xi) + xi);
  }
} // namespace quoin
