// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/step_count.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  double count_steps(const double duration, const double step,
                     const double most, const std::string &what,
                     const std::string &cure)
  {
    const double n = std::max(1., std::ceil(duration / step * (1. - 1e-12)));
    if (!(n <= most))
      throw InputError(what + " takes " + number_text(n) + " time steps of "
                       + number_text(step) + " s, more than "
                       + number_text(most) + ". " + cure);
    return n;
  }
} // namespace quoin
