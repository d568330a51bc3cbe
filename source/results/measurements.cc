// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/state.h>
#include <quoin/base/wall_clock.h>
#include <quoin/results/measurements.h>
#include <quoin/output/progress.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdint>
#include <sstream>

namespace quoin
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Number of budgets allowed for a whole period. */
    constexpr double patience = 4.;

    dealii::Utilities::System::MemoryStats memory_stats()
    {
      dealii::Utilities::System::MemoryStats stats;
      dealii::Utilities::System::get_memory_stats(stats);
      return stats;
    }
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
      // The next series takes as long as all before.
      const double to_come
          = MPI::broadcast(communicator, seconds_since(begin) + 2. * row);
      if (to_come > (n_calls < period ? patience : 1.) * budget)
        break;
    }
    const double all  = seconds_since(begin);
    const double rest = (all - first) / double(n_calls - 1);
    const double mean = period == 1        ? row / double(n)
                        : n_calls < period ? rest + (first - rest) / period
                                           : all / double(n_calls);
    return MPI::broadcast(communicator, mean);
  }

  double resident_memory(const MPI_Comm communicator)
  {
    return MPI::sum(1024. * double(memory_stats().VmRSS), communicator);
  }

  double peak_memory(const MPI_Comm communicator)
  {
    return MPI::max(1024. * double(memory_stats().VmHWM), communicator);
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
    text << seconds << " s";
    return text.str();
  }

  double memory_bandwidth(const double bytes)
  {
    constexpr std::size_t least = 4096; // beyond the resolution of the clock
    const std::size_t n
        = std::max(least, std::size_t(bytes / (3. * sizeof(double))));
    AlignedArray<double> a(n, 0.), b(n, 1.);
    double best      = 0.;
    const auto start = WallClock::now();
    do
    {
      const auto begin = WallClock::now();
      for (std::size_t i = 0; i < n; ++i)
        a[i] += 0.5 * b[i];
      best = std::max(best, 3. * n * sizeof(double) / seconds_since(begin));
    } while (seconds_since(start) < 0.5);
    return best;
  }

  double step_bytes(const double n_nodes, const double n_cells)
  {
    constexpr double per_node = 2 * sizeof(NodeRecord<2>)
                                + 4 * sizeof(dealii::Tensor<1, 2>)
                                + sizeof(double);
    return n_nodes * per_node + n_cells * sizeof(std::uint32_t);
  }
} // namespace quoin
