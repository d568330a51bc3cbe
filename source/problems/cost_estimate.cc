// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/cost_estimate.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/results/progress.h>
#include <quoin/tdbem/clustered_history.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdint>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Budgets that may be spent for a whole period. */
    constexpr double patience = 4.;
  } // namespace

  double seconds_per_call(const std::function<void()> &task,
                          const double budget, const MPI_Comm communicator,
                          const unsigned int period)
  {
    const auto begin = WallClock::now();
    task();
    const double first = seconds_since(begin);
    double row         = 0.;
    std::uint64_t n = 1, n_calls = 1;
    for (;; n *= 2)
    {
      const auto start = WallClock::now();
      for (std::uint64_t i = 0; i < n; ++i)
        task();
      row = seconds_since(start);
      n_calls += n;
      // The next row takes as long as all before.
      const double to_come = dealii::Utilities::MPI::broadcast(
          communicator, seconds_since(begin) + 2. * row);
      if (to_come > (n_calls < period ? patience : 1.) * budget)
        break;
    }
    const double all  = seconds_since(begin);
    const double rest = (all - first) / double(n_calls - 1);
    const double mean = period == 1        ? row / double(n)
                        : n_calls < period ? rest + (first - rest) / period
                                           : all / double(n_calls);
    return dealii::Utilities::MPI::broadcast(communicator, mean);
  }

  unsigned int period_of(const BoundaryHistory &history)
  {
    const auto *clustered = dynamic_cast<const ClusteredHistory *>(&history);
    return clustered ? clustered->block_size() : 1;
  }

  PlannedOutput planned_output(const Parameters &parameters,
                               const std::vector<double> &time_steps)
  {
    PlannedOutput result;
    const auto count
        = [](const double n) { return std::uint64_t(std::min(n, 1e18)); };
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      // One where the stage ends, whatever the intervals.
      ++result.moments;
      ++result.rows;
      if (stage.end != StageEnd::time || stage.slows_loads())
        result.is_least = true;
      if (stage.end != StageEnd::time)
        continue;
      if (parameters.field_interval > 0.)
        result.moments
            += count(stage.duration / parameters.field_interval * (1. + 1e-9));
      if (i < time_steps.size())
        result.rows
            += count(stage.duration
                     / std::max(parameters.history_interval, time_steps[i]));
    }
    return result;
  }

  double bytes_of_fields(const Model &model)
  {
    // Arrays of vtu files, as BlockOutput and JointOutput have them.
    constexpr double of_node = 3 * 3 * 8, of_cell = 4 * 8 + 2 * 8 + 3 * 3 * 8
                                                    + 2 * 4 + 3 * 4 + 4 + 1;
    constexpr double of_plastic_cell = 4 + 8;
    const double of_joint_point
        = 2 * 3 * 8 + 4 * 8 + 1 + 8 * model.joints().field_names().size();
    constexpr double of_joint = 1 + 4 + 8 + 2 * 4 + 4 + 1;
    constexpr double of_files = 5000.; // XML
    const double n_cells      = model.nodes().n_cells();
    double bytes
        = of_files + of_node * model.exchange().n_owned() + of_cell * n_cells;
    if (model.blocks().is_plastic())
      bytes += of_plastic_cell * n_cells;
    for (unsigned int i = 0; i < model.joints().n_segments(); ++i)
      if (model.nodes().joint_faces()[model.joints().segment(i).face].is_own[0])
        bytes += of_joint + 2. * of_joint_point;
    return dealii::Utilities::MPI::sum(bytes, model.exchange().communicator());
  }

  double bytes_of_row(const std::size_t n_columns)
  {
    constexpr double of_number = 18.;
    return of_number * double(n_columns);
  }

  double resident_memory(const MPI_Comm communicator)
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    return dealii::Utilities::MPI::sum(1024. * double(stats.VmRSS),
                                       communicator);
  }

  std::string bytes_text(const double bytes)
  {
    const char *const units[] = { "kB", "MB", "GB", "TB" };
    double value              = bytes / 1e3;
    unsigned int unit         = 0;
    for (; value >= 999.5 && unit < 3; ++unit)
      value /= 1e3;
    std::ostringstream text;
    text.precision(value < 10. ? 2 : 3);
    text << (value < 1. ? 1. : value) << " " << units[unit];
    return text.str();
  }

  std::string seconds_text(const double seconds)
  {
    if (seconds >= 10.)
      return duration_text(seconds);
    std::ostringstream text;
    text.precision(2);
    text << seconds;
    return text.str() + " s";
  }
} // namespace quoin
