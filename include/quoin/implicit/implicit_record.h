// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_implicit_record_h
#define quoin_implicit_implicit_record_h

#include <cstdint>
#include <vector>

namespace quoin
{
  /** One iteration of a step, for convergence.csv. */
  struct IterationReport
  {
    std::uint64_t step;
    unsigned int attempt;    /**< 0, increased by one with each cut */
    unsigned int iteration;  /**< 0: before the first correction */
    double load_time;        /**< [s] */
    double unbalanced_ratio; /**< [-] */
    double line_search;      /**< applied share of the correction [-] */
    double linear_iterations;
  };

  /** A jump from one equilibrium to another at constant loads. */
  struct JumpReport
  {
    double load_time; /**< [s] */
    unsigned int n_steps;
    double loss; /**< energy dissipated by drag [J] */
  };

  /** Iterations and jumps of an ImplicitSolver. */
  struct ImplicitRecord
  {
    std::vector<IterationReport> iterations; /**< iterations not yet reported */
    std::vector<JumpReport> jumps;           /**< ended, not yet reported */
    std::uint64_t n_iterations = 0, n_cuts = 0;
  };
} // namespace quoin

#endif
