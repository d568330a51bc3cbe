// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_block_report_h
#define quoin_problems_block_report_h

#include <quoin/problems/block_stage.h>

namespace quoin
{
  // What a problem of blocks says before its first step. Stages are begun with
  // copies of the state; all functions are collective.

  /** Sizes, and warnings of what is likely a mistake; with RunOptions::check
      also materials, joints and loads. */
  void report_model(BlockContext &context);

  /** The time step of each stage, or its unknowns, and warnings; finds what is
      wrong with stages. */
  void report_stages(BlockContext &context);

  /** Time, memory and disk that the run takes; measures for half a second. */
  void report_costs(BlockContext &context);
} // namespace quoin

#endif
