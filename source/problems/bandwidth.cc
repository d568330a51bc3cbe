// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/bandwidth.h>
#include <quoin/base/node_vector.h>

#include <algorithm>
#include <chrono>

namespace quoin
{
  double memory_bandwidth(const double bytes)
  {
    using Clock              = std::chrono::steady_clock;
    const auto seconds_since = [](const Clock::time_point start)
    { return std::chrono::duration<double>(Clock::now() - start).count(); };
    constexpr std::size_t least = 4096; // beyond the resolution of the clock
    const std::size_t n
        = std::max(least, std::size_t(bytes / (3. * sizeof(double))));
    AlignedArray<double> a(n, 0.), b(n, 1.);
    double best      = 0.;
    const auto start = Clock::now();
    do
    {
      const auto begin = Clock::now();
      for (std::size_t i = 0; i < n; ++i)
        a[i] += 0.5 * b[i];
      best = std::max(best, 3. * n * sizeof(double) / seconds_since(begin));
    } while (seconds_since(start) < 0.5);
    return best;
  }

  double step_bytes(const double n_nodes, const double n_cells)
  {
    constexpr double per_node = 2 * sizeof(NodeRecord<2>)
                                + 4 * sizeof(NodeVector<2>) + sizeof(double);
    return n_nodes * per_node + n_cells * sizeof(std::uint32_t);
  }
} // namespace quoin
