// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_measurements_h
#define quoin_results_measurements_h

#include <mpi.h>

#include <functional>
#include <string>

namespace quoin
{
  // Time, memory and their texts. What has a communicator is collective.

  /**
   * Seconds that a call of @p task takes in the mean, which is called in ever
   * longer rows for up to @p budget seconds, but at least twice. Without a
   * period the first call, which may have to allocate, does not count; else it
   * is one that costs more, as every @p period calls, of which as many are
   * taken if four budgets are enough. The first rank's clock counts.
   */
  double seconds_per_call(const std::function<void()> &task, double budget,
                          MPI_Comm communicator, unsigned int period = 1);

  /** Memory that all ranks have now [B]. */
  double resident_memory(MPI_Comm communicator);

  /** Largest memory that a rank has had so far [B]. */
  double peak_memory(MPI_Comm communicator);

  /** "12 MB" */
  std::string bytes_text(double bytes);

  /** "0.3 s", "12 s", "3:05 min" */
  std::string seconds_text(double seconds);

  /**
   * Bandwidth [B/s] that this rank gets where it streams @p bytes, by the
   * update a = a + s b, which reads both arrays and writes one; best of half a
   * second. So many bytes come from where those of a step do, memory or a
   * cache.
   */
  double memory_bandwidth(double bytes);

  /**
   * Bytes that one undamped step must move to and from memory if each array
   * is streamed once: node records, velocities, forces, masses, and the node
   * number that each cell adds to its strip.
   */
  double step_bytes(double n_nodes, double n_cells);
} // namespace quoin

#endif
