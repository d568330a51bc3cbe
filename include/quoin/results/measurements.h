// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_measurements_h
#define quoin_results_measurements_h

#include <mpi.h>

#include <functional>
#include <string>

namespace quoin
{
  // Time, memory and their texts. Functions with a communicator are collective.

  /**
   * Mean time of a call of @p task [s], which is called in ever longer series
   * for up to @p budget [s], but at least twice. Without a period the first
   * call, which may allocate, does not count; with one, every @p period-th call
   * costs more, beginning with the first, and a whole period is measured if
   * four budgets are enough. The first rank's clock counts.
   */
  double seconds_per_call(const std::function<void()> &task, double budget,
                          MPI_Comm communicator, unsigned int period = 1);

  /** Present memory of all ranks [B]. */
  double resident_memory(MPI_Comm communicator);

  /** Largest memory of a rank so far [B]. */
  double peak_memory(MPI_Comm communicator);

  /** "12 MB" */
  std::string bytes_text(double bytes);

  /** "0.3 s", "12 s", "3:05 min" */
  std::string seconds_text(double seconds);

  /**
   * Bandwidth [B/s] that this rank gets where it streams @p bytes, by the
   * update a = a + s b, which reads both arrays and writes one; best of half a
   * second. Choose the bytes of a step, so that they come from the same level,
   * memory or a cache.
   */
  double memory_bandwidth(double bytes);

  /** What a step goes through. */
  struct StepSize
  {
    double n_nodes, n_cells, n_joint_points, n_contacts;
  };

  /**
   * Bytes that one undamped step must move to and from memory if each array
   * is streamed once: node records, velocities, forces, masses, and the node
   * number that each cell adds to its strip; of points of joints that stick
   * tractions, plastic gaps, state, area and nodes; general contacts with their
   * edges. @p dim: 2 or 3.
   */
  double step_bytes(int dim, const StepSize &size);

  /** "L1 cache", "L2 cache", "L3 cache" or "memory": the smallest of those of
      this processor that holds @p bytes. */
  std::string smallest_store(double bytes);
} // namespace quoin

#endif
