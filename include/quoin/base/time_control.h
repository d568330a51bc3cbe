// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_time_control_h
#define quoin_base_time_control_h

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace quoin
{
  /**
   * Output times: whether a multiple of an interval is nearest to a step. It
   * has no memory, so that a resumed run has the same output times.
   */
  class TimeControl
  {
  public:
    /** @p interval [s]; 0: every step; negative: never. */
    explicit TimeControl(const double interval = -1.) : interval(interval)
    {
    }

    /** Whether output is due at @p time [s], with steps of @p dt [s]. */
    bool is_due(const double time, const double dt) const
    {
      if (interval < 0.)
        return false;
      if (interval <= dt)
        return true;
      // Where a multiple lies midway between two steps rounding decides, for
      // each of them by itself, and both or none would be due: the border is
      // shifted by a share of the step that no ratio of times is.
      constexpr double shift = 1e-3 / constants::pi;
      const double offset    = time - std::round(time / interval) * interval;
      return offset > (shift - 0.5) * dt && offset <= (shift + 0.5) * dt;
    }

  private:
    double interval;
  };

  /**
   * Number of steps of at most @p step [s] in @p duration [s], at least one; an
   * integer up to rounding is not rounded up. Throws an InputError, "@p what
   * takes ... steps ... @p cure", if they are more than @p most.
   */
  inline double count_steps(const double duration, const double step,
                            const double most, const std::string &what,
                            const std::string &cure)
  {
    const double n = std::max(1., std::ceil(duration / step * (1. - 1e-12)));
    if (!(n <= most))
      throw InputError(text_of(what, " takes ", n, " time steps of ", step,
                               " s, more than ", most, ". ", cure));
    return n;
  }
} // namespace quoin

#endif
