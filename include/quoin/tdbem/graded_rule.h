// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_graded_rule_h
#define quoin_tdbem_graded_rule_h

#include <quoin/elastodynamics/gauss_legendre.h>

namespace quoin
{
  /**
   * The Gauss-Legendre rule with @p n points t moved to x = 3 t^2 - 2 t^3,
   * which crowd at both ends of [0, 1]: a function that begins like the power
   * k + 1/2 of the distance from an end is smooth in t.
   */
  GaussRule graded_rule(unsigned n);

  /**
   * As graded_rule(), with the regularised incomplete beta function
   * x = I_t(8, 8),
   * which begins like t^8, for functions that are logarithmic at an end.
   */
  GaussRule strongly_graded_rule(unsigned n);
} // namespace quoin

#endif
