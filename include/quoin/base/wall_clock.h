// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_wall_clock_h
#define quoin_base_wall_clock_h

#include <chrono>

namespace quoin
{
  using WallClock = std::chrono::steady_clock;

  inline double seconds_between(const WallClock::time_point start,
                                const WallClock::time_point end)
  {
    return std::chrono::duration<double>(end - start).count();
  }

  /** Wall-clock time since @p start [s]. */
  inline double seconds_since(const WallClock::time_point start)
  {
    return seconds_between(start, WallClock::now());
  }
} // namespace quoin

#endif
