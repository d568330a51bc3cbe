// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/graded_rule.h>

#include <boost/math/special_functions/beta.hpp>

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
      rule.points[k] = boost::math::ibeta(8., 8., t);
      rule.weights[k] *= boost::math::ibeta_derivative(8., 8., t);
    }
    return rule;
  }
} // namespace quoin
