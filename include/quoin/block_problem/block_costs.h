// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_block_costs_h
#define quoin_block_problem_block_costs_h

#include <quoin/block_problem/block_stage.h>

namespace quoin
{
  /** Reports time, memory and disk space of a run of blocks, by measurements of
      about half a second, for --check. Collective. */
  template <int dim>
  void report_block_costs(BlockContext<dim> &context);
} // namespace quoin

#endif
