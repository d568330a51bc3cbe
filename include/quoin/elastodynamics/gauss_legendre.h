// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_gauss_legendre_h
#define quoin_elastodynamics_gauss_legendre_h

#include <vector>

namespace quoin
{
  /** Points and weights on [0, 1]; the weights sum to one. */
  struct GaussRule
  {
    std::vector<double> points;
    std::vector<double> weights;
  };

  /**
   * The Gauss-Legendre rule with @p n points, 1 <= n <= 64, to rounding.
   */
  const GaussRule &gauss_legendre(unsigned n);
} // namespace quoin

#endif
