// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_tdbem_quadrature_h
#define quoin_tests_tdbem_quadrature_h

#include <cmath>

namespace quoin::test
{
  /**
   * Calls add(x, weight) for the points of the tanh-sinh rule on [a, b],
   * which converges to rounding whatever singularities the ends have. The
   * integrand should be analytic between them.
   */
  template <typename Add>
  void tanh_sinh(const double a, const double b, const Add &add,
                 const double h = 1. / 16.)
  {
    constexpr double half_pi = 1.57079632679489662;
    const int n              = int(3.4 / h);
    for (int k = -n; k <= n; ++k)
    {
      const double s = half_pi * std::sinh(k * h);
      // 1/2 (1 - tanh |s|), the share of the nearer end, without cancellation.
      const double share  = std::exp(-std::abs(s)) / (2. * std::cosh(s));
      const double cosine = std::cosh(s);
      const double weight
          = 0.5 * (b - a) * h * half_pi * std::cosh(k * h) / (cosine * cosine);
      add(k < 0 ? a + (b - a) * share : b - (b - a) * share, weight);
    }
  }
} // namespace quoin::test

#endif
