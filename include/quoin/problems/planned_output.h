// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_planned_output_h
#define quoin_problems_planned_output_h

#include <quoin/problems/problem.h>

#include <cstdint>
#include <string>
#include <vector>

namespace quoin
{
  /** Output of a run, as far as its stages end by time. */
  struct PlannedOutput
  {
    std::uint64_t fields = 0;     /**< output times of fields */
    std::uint64_t rows   = 0;     /**< rows of histories.csv and energies.csv */
    bool is_least        = false; /**< a stage may write more */
  };

  /** @p time_steps: of each stage [s]; empty: rows are not counted. */
  PlannedOutput planned_output(const Parameters &parameters,
                               const std::vector<double> &time_steps);

  /**
   * Reports the memory of all ranks, followed by @p more, and the disk space of
   * @p planned, with @p bytes_of_fields for each output time [B] and
   * @p n_columns numbers in the rows of all tables.
   */
  void report_memory_and_disk(const RunContext &run, const std::string &more,
                              const PlannedOutput &planned,
                              double bytes_of_fields, std::size_t n_columns);
} // namespace quoin

#endif
