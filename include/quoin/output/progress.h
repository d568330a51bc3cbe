// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_progress_h
#define quoin_output_progress_h

#include <chrono>
#include <cstdint>
#include <limits>
#include <string>

namespace quoin
{
  class Log;

  /** Progress of a run and indicators of its quality. */
  struct ProgressFigures
  {
    std::string stage;
    double time        = 0.; /**< [s] */
    std::uint64_t step = 0;
    /** Completed share of the stage, 0 to 1; negative if its end is unknown. */
    double fraction = -1.;
    /** Safety factor on the time step; NaN leaves each of these out. */
    double share_of_critical = std::numeric_limits<double>::quiet_NaN();
    double unbalanced_ratio  = std::numeric_limits<double>::quiet_NaN();
    /** Energy residual divided by the largest energy so far. */
    double energy_residual = std::numeric_limits<double>::quiet_NaN();
  };

  /**
   * Shows the progress of a run: on a terminal one line with a bar that is
   * redrawn at most five times a second; otherwise, and in the log file, a
   * line every few seconds.
   */
  class Progress
  {
  public:
    /** @param interval between lines [s] */
    explicit Progress(Log &log, const double interval = 5.);

    /** Begins a stage, from which rates and the remaining time are counted. */
    void start(const ProgressFigures &figures);

    /**
     * Whether update() would show anything; false on all ranks but 0. It is
     * cheap (20 ns) and can be called after each step, so that costly figures
     * are computed only when they are shown.
     */
    bool due() const;

    void update(const ProgressFigures &figures);

    /** Ends a stage: removes the bar; writes a line if steps were taken. */
    void finish(const ProgressFigures &figures);

  private:
    using Clock = std::chrono::steady_clock;

    std::string figures_text(const ProgressFigures &figures) const;
    std::string line(const ProgressFigures &figures) const;
    std::string bar(const ProgressFigures &figures) const;
    std::string time_to_go(const ProgressFigures &figures) const;

    Log &log;
    Clock::duration line_interval;
    Clock::duration bar_interval;
    Clock::time_point started;
    Clock::time_point last_line;
    Clock::time_point last_bar;
    std::uint64_t first_step = 0;
    double first_fraction    = 0.;
  };

  /** A duration [s] as "12 s", "3:05 min", "2:07 h" or "1.5 days". */
  std::string duration_text(const double seconds);
} // namespace quoin

#endif
