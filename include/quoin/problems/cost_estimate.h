// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_cost_estimate_h
#define quoin_problems_cost_estimate_h

#include <quoin/problems/parameters.h>
#include <quoin/dynamics/model.h>
#include <quoin/tdbem/boundary_history.h>

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>

namespace quoin
{
  /**
   * Seconds that a call of @p task takes in the mean, which is called in ever
   * longer rows for up to @p budget seconds, but at least twice. Without a
   * period the first call, which may have to allocate, does not count; else it
   * is one that costs more, as every @p period calls, of which as many are
   * taken if four budgets are enough. The first rank's clock counts;
   * collective.
   */
  double seconds_per_call(const std::function<void()> &task, double budget,
                          MPI_Comm communicator, unsigned int period = 1);

  /** After how many steps a history of boundary elements costs more again. */
  unsigned int period_of(const BoundaryHistory &history);

  /** What a run writes, as far as its stages end by time. */
  struct PlannedOutput
  {
    std::uint64_t moments = 0;     /**< of fields */
    std::uint64_t rows    = 0;     /**< of histories.csv and energies.csv */
    bool is_least         = false; /**< a stage may write more */
  };

  /** @p time_steps: of each stage [s]; empty: rows are not counted. */
  PlannedOutput planned_output(const Parameters &parameters,
                               const std::vector<double> &time_steps);

  /** Of blocks.pvd and joints.pvd for one moment, all ranks [B]; collective. */
  double bytes_of_fields(const Model &model);

  /** Of a row of a table with @p n_columns [B]. */
  double bytes_of_row(std::size_t n_columns);

  /** Resident memory of all ranks [B]; collective. */
  double resident_memory(MPI_Comm communicator);

  /** "12 MB" */
  std::string bytes_text(double bytes);

  /** "0.3 s", "12 s", "3:05 min" */
  std::string seconds_text(double seconds);
} // namespace quoin

#endif
