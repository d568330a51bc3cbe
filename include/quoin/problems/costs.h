// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_costs_h
#define quoin_problems_costs_h

#include <quoin/problems/block_stage.h>
#include <quoin/problems/boundary_stage.h>
#include <quoin/results/measurements.h>

#include <string>
#include <vector>

namespace quoin
{
  // What a run takes, by measurements of about half a second, for --check;
  // collective.

  /** Says what time, memory and disk a run of blocks takes. */
  void report_block_costs(BlockContext &context);

  /** The same of boundary elements alone; spoils the history of @p system. */
  void report_boundary_costs(BoundarySystem &system, const StepControl &control,
                             const RunContext &run);

  /** What a run writes, as far as its stages end by time. */
  struct PlannedOutput
  {
    std::uint64_t fields = 0;     /**< output times of fields */
    std::uint64_t rows   = 0;     /**< of histories.csv and energies.csv */
    bool is_least        = false; /**< a stage may write more */
  };

  /** @p time_steps: of each stage [s]; empty: rows are not counted. */
  PlannedOutput planned_output(const Parameters &parameters,
                               const std::vector<double> &time_steps);

  /**
   * Says the memory that all ranks have taken, with @p more to come, and the
   * disk that @p planned takes, with @p bytes_of_fields for each output time
   * [B] and @p n_columns numbers in the rows of all tables.
   */
  void report_memory_and_disk(const RunContext &run, const std::string &more,
                              const PlannedOutput &planned,
                              double bytes_of_fields, std::size_t n_columns);
} // namespace quoin

#endif
