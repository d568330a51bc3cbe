// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_time_control_h
#define quoin_base_time_control_h

#include <cmath>

namespace quoin
{
  /**
   * Whether a multiple of an interval is nearest to this step. Keeps no
   * memory, so that a resumed run answers as the uninterrupted one did.
   */
  class TimeControl
  {
  public:
    /** @p interval [s]; 0: every step; negative: never. */
    explicit TimeControl(const double interval = -1.) : interval(interval)
    {
    }

    /** At @p time [s], with steps of @p dt [s]. */
    bool is_due(const double time, const double dt) const
    {
      if (interval < 0.)
        return false;
      if (interval <= dt)
        return true;
      const double offset = time - std::round(time / interval) * interval;
      return offset > -0.5 * dt && offset <= 0.5 * dt;
    }

  private:
    double interval;
  };
} // namespace quoin

#endif
