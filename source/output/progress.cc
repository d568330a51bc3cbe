// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/log.h>
#include <quoin/output/progress.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace quoin
{
  namespace
  {
    constexpr unsigned int bar_width = 10;

    template <typename... Values>
    std::string formatted(const char *format, const Values... values)
    {
      char text[160];
      std::snprintf(text, sizeof(text), format, values...);
      return text;
    }

    double seconds(const std::chrono::steady_clock::duration duration)
    {
      return std::chrono::duration<double>(duration).count();
    }
  } // namespace

  std::string duration_text(const double seconds)
  {
    if (!(seconds < 8.64e6))
      return "long";
    const auto s = static_cast<unsigned int>(std::max(seconds, 0.) + 0.5);
    if (s < 60)
      return formatted("%u s", s);
    if (s < 3600)
      return formatted("%u:%02u min", s / 60, s % 60);
    if (s < 2 * 86400)
      return formatted("%u:%02u h", s / 3600, s / 60 % 60);
    return formatted("%.1f days", seconds / 86400);
  }

  Progress::Progress(Log &log, const double interval)
    : log(log), line_interval(std::chrono::duration_cast<Clock::duration>(
                    std::chrono::duration<double>(interval))),
      bar_interval(std::chrono::milliseconds(200))
  {
  }

  void Progress::start(const ProgressFigures &figures)
  {
    started        = Clock::now();
    last_line      = started;
    last_bar       = started;
    first_step     = figures.step;
    first_fraction = std::max(figures.fraction, 0.);
  }

  bool Progress::due() const
  {
    if (!log.is_active())
      return false;
    const Clock::time_point now = Clock::now();
    return now - last_line >= line_interval
           || (log.has_terminal() && now - last_bar >= bar_interval);
  }

  void Progress::update(const ProgressFigures &figures)
  {
    const Clock::time_point now = Clock::now();
    if (now - last_line >= line_interval)
    {
      last_line = now;
      log.progress(line(figures));
    }
    if (now - last_bar >= bar_interval)
    {
      last_bar = now;
      log.status(bar(figures));
    }
  }

  void Progress::finish(const ProgressFigures &figures)
  {
    log.status("");
    // A stage without steps needs no line.
    if (figures.step == first_step
        && std::max(figures.fraction, 0.) == first_fraction)
      return;
    log.message(figures.stage
                + ": ended at t = " + formatted("%.6g s", figures.time)
                + " after " + std::to_string(figures.step - first_step)
                + " steps in " + duration_text(seconds(Clock::now() - started))
                + figures_text(figures));
  }

  std::string Progress::figures_text(const ProgressFigures &figures) const
  {
    const double elapsed = seconds(Clock::now() - started);
    std::string text;
    if (elapsed > 0. && figures.step > first_step)
      text += formatted(", %.4g steps/s",
                        static_cast<double>(figures.step - first_step)
                            / elapsed);
    if (!std::isnan(figures.share_of_critical))
      text += formatted(", dt %.0f%% of critical",
                        100. * figures.share_of_critical);
    if (!std::isnan(figures.unbalanced_ratio))
      text += formatted(", unbalanced %.2g", figures.unbalanced_ratio);
    if (!std::isnan(figures.energy_residual))
      text += formatted(", energy residual %.1g", figures.energy_residual);
    return text;
  }

  std::string Progress::time_to_go(const ProgressFigures &figures) const
  {
    const double done = figures.fraction - first_fraction;
    if (!(done > 0.))
      return "";
    const double elapsed = seconds(Clock::now() - started);
    return ", " + duration_text(elapsed * (1. - figures.fraction) / done)
           + " to go";
  }

  std::string Progress::line(const ProgressFigures &figures) const
  {
    std::string text = figures.stage + ": ";
    if (figures.fraction >= 0.)
      text += formatted("%.1f%%, ", 100. * figures.fraction);
    return text + formatted("t = %.6g s, step ", figures.time)
           + std::to_string(figures.step) + time_to_go(figures)
           + figures_text(figures);
  }

  std::string Progress::bar(const ProgressFigures &figures) const
  {
    if (figures.fraction < 0.)
      return line(figures);
    const double fraction     = std::min(figures.fraction, 1.);
    const unsigned int filled = std::lround(fraction * bar_width);
    return figures.stage + " [" + std::string(filled, '=')
           + std::string(bar_width - filled, ' ') + "] "
           + formatted("%3.0f%%, t = %.4g s", 100. * fraction, figures.time)
           + time_to_go(figures) + figures_text(figures);
  }
} // namespace quoin
