// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/graded_rule.h>

namespace quoin
{
  GaussRule graded_rule(const unsigned n)
  {
    GaussRule rule = gauss_legendre(n);
    for (unsigned k = 0; k < n; ++k)
    {
      const double t = rule.points[k];
      rule.points[k] = t * t * (3. - 2. * t);
      rule.weights[k] *= 6. * t * (1. - t);
    }
    return rule;
  }

  GaussRule strongly_graded_rule(const unsigned n)
  {
    GaussRule rule = gauss_legendre(n);
    for (unsigned k = 0; k < n; ++k)
    {
      const double t = rule.points[k];
      rule.points[k] = t * t * t * (10. - 15. * t + 6. * t * t);
      rule.weights[k] *= 30. * t * t * (1. - t) * (1. - t);
    }
    return rule;
  }
} // namespace quoin
