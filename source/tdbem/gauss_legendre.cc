// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/gauss_legendre.h>

#include <array>
#include <cmath>

namespace quoin
{
  namespace
  {
    constexpr unsigned n_rules = 64;

    GaussRule make_rule(const unsigned n)
    {
      GaussRule rule{ std::vector<double>(n), std::vector<double>(n) };
      for (unsigned k = 0; k < n; ++k)
      {
        double x = std::cos(3.14159265358979323846 * (k + 0.75) / (n + 0.5));
        double derivative = 0.;
        // Newton's method doubles the digits of a start that has three.
        for (unsigned iteration = 0; iteration < 6; ++iteration)
        {
          double value = 1., previous = 0.;
          for (unsigned j = 1; j <= n; ++j)
          {
            const double next
                = ((2. * j - 1.) * x * value - (j - 1.) * previous) / j;
            previous = value;
            value    = next;
          }
          derivative = n * (x * value - previous) / (x * x - 1.);
          x -= value / derivative;
        }
        rule.points[k]  = 0.5 * (1. - x);
        rule.weights[k] = 1. / ((1. - x * x) * derivative * derivative);
      }
      return rule;
    }
  } // namespace

  const GaussRule &gauss_legendre(const unsigned n)
  {
    static const std::array<GaussRule, n_rules + 1> rules = []
    {
      std::array<GaussRule, n_rules + 1> all;
      for (unsigned k = 1; k <= n_rules; ++k)
        all[k] = make_rule(k);
      return all;
    }();
    return rules.at(n);
  }
} // namespace quoin
