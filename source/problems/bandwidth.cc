// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/bandwidth.h>
#include <quoin/base/state.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace quoin
{
  double memory_bandwidth()
  {
    constexpr std::size_t n = 1 << 23; // 64 MiB an array
    AlignedArray<double> a(n, 0.), b(n, 1.), c(n, 2.);
    double best = 0.;
    for (unsigned int run = 0; run < 6; ++run)
    {
      const auto start = std::chrono::steady_clock::now();
      const double s   = 0.5 + run;
      for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + s * c[i];
      const double seconds = std::chrono::duration<double>(
                                 std::chrono::steady_clock::now() - start)
                                 .count();
      best = std::max(best, 3. * n * sizeof(double) / seconds);
      std::swap(a, b);
    }
    return best;
  }

  double step_bytes(const double n_nodes, const double n_cells)
  {
    constexpr double per_node = 2 * sizeof(NodeRecord<2>)
                                + 4 * sizeof(NodeVector<2>) + sizeof(double);
    return n_nodes * per_node + n_cells * sizeof(std::uint32_t);
  }
} // namespace quoin
