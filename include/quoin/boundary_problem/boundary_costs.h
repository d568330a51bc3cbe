// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_boundary_problem_boundary_costs_h
#define quoin_boundary_problem_boundary_costs_h

#include <quoin/boundary_problem/boundary_stage.h>

namespace quoin
{
  /** Reports costs of boundary elements alone, by measurements of about half a
      second, for --check; invalidates the history of @p system. Collective. */
  void report_boundary_costs(BoundarySystem &system, const StepControl &control,
                             const RunContext &run);
} // namespace quoin

#endif
