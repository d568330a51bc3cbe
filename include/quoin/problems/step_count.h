// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_step_count_h
#define quoin_problems_step_count_h

#include <string>

namespace quoin
{
  /**
   * Steps of at most @p step [s] in @p duration [s], one at least; a quotient
   * that should be whole is not rounded up. Throws an InputError, "@p what
   * takes ... steps ... @p cure", if they are more than @p most.
   */
  double count_steps(double duration, double step, double most,
                     const std::string &what, const std::string &cure);
} // namespace quoin

#endif
