// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/elastodynamics/gauss_legendre.h>

#include <deal.II/base/quadrature_lib.h>

#include <array>

namespace quoin
{
  namespace
  {
    constexpr unsigned n_rules = 64;

    GaussRule make_rule(const unsigned n)
    {
      const dealii::QGauss<1> quadrature(n);
      GaussRule rule;
      for (const dealii::Point<1> &point : quadrature.get_points())
        rule.points.push_back(point[0]);
      rule.weights = quadrature.get_weights();
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
