// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_phase_clock_h
#define quoin_base_phase_clock_h

#include <quoin/base/wall_clock.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Wall time of the phases of steps. A step of a small model takes a
   * microsecond, in which reading a clock between all phases would be costly:
   * one step in many is measured and counts for all of them, while rare phases,
   * such as output, are always measured.
   */
  class PhaseClock
  {
  public:
    /** Steps per measured step on average; they follow on each other at random
        distances, so that tasks of every so many steps are sampled in
        proportion. */
    static constexpr unsigned int steps_per_sample = 17;

    /** Number of the phase @p name, added if it is new. */
    unsigned int phase(const std::string &name)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found != names.end())
        return found - names.begin();
      names.push_back(name);
      seconds.push_back(0.);
      return names.size() - 1;
    }

    void begin_step()
    {
      weight = 0.;
      if (--until_sample > 0)
        return;
      weight = steps_per_sample;
      last   = WallClock::now();
      // A linear congruential generator, whose high digits vary most.
      random       = 1664525U * random + 1013904223U;
      until_sample = 1 + (random >> 16) % (2 * steps_per_sample - 1);
    }

    /** Books the time since begin_step() or the last lap to @p phase. */
    void lap(const unsigned int phase)
    {
      if (weight == 0.)
        return;
      const auto now = WallClock::now();
      seconds[phase] += weight * seconds_between(last, now);
      last = now;
    }

    /** Runs @p task and books its time, which within a step is excluded from
        laps. */
    template <typename Task>
    void measure(const unsigned int phase, const Task &task)
    {
      const auto start = WallClock::now();
      task();
      const auto end = WallClock::now();
      seconds[phase] += seconds_between(start, end);
      last += end - start;
    }

    const std::vector<std::string> &phases() const
    {
      return names;
    }
    /** Estimated time in a phase [s]. */
    double time(const unsigned int phase) const
    {
      return seconds[phase];
    }

  private:
    std::vector<std::string> names;
    std::vector<double> seconds;
    WallClock::time_point last;
    double weight             = 0.;
    unsigned int until_sample = steps_per_sample;
    std::uint32_t random      = 1;
  };
} // namespace quoin

#endif
