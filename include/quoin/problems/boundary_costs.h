// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_boundary_costs_h
#define quoin_problems_boundary_costs_h

#include <quoin/problems/domain_results.h>

namespace quoin
{
  /**
   * Says what a run of boundary elements alone takes: time, memory, disk.
   * Takes about half a second, and spoils the history of @p system.
   * Collective.
   */
  void report_boundary_costs(BoundarySystem &system, const StepControl &control,
                             const RunContext &run);
} // namespace quoin

#endif
