// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/state.h>
#include <quoin/base/wall_clock.h>
#include <quoin/contact_geometry/contact_state.h>
#include <quoin/results/measurements.h>
#include <quoin/output/progress.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <utility>

#include <unistd.h>

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

  double step_bytes(const int dim, const StepSize &size)
  {
    // Positions and displacements are read and written, so are a velocity and a
    // force; a mass.
    const double node = (2 * 2 * dim + 4 * dim + 1) * sizeof(double);
    // Tractions are written; plastic gaps and areas are read.
    const double point = (2 * dim + 1) * sizeof(double)
                         + 2 * sizeof(std::uint32_t) + sizeof(std::uint8_t);
    // Two edges of eight numbers.
    const double contact = 2 * sizeof(ContactPair) + 2 * 8 * sizeof(double);
    return size.n_nodes * node + size.n_cells * sizeof(std::uint32_t)
           + size.n_joint_points * point + size.n_contacts * contact;
  }

  std::string smallest_store(const double bytes)
  {
    for (const auto &[size, name] :
         { std::pair(_SC_LEVEL1_DCACHE_SIZE, "L1 cache"),
           std::pair(_SC_LEVEL2_CACHE_SIZE, "L2 cache"),
           std::pair(_SC_LEVEL3_CACHE_SIZE, "L3 cache") })
      if (bytes <= double(sysconf(size)))
        return name;
    return "memory";
  }
} // namespace quoin
