// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_block_stage_h
#define quoin_problems_block_stage_h

#include <quoin/problems/block_outputs.h>
#include <quoin/problems/block_system.h>
#include <quoin/problems/problem.h>
#include <quoin/problems/stage_steps.h>

#include <cstdint>

namespace quoin
{
  /** What the parts of a problem of blocks work on. */
  struct BlockContext
  {
    const RunContext &run;
    BlockSystem &system;
    StageSteps &steps;
    BlockOutputs &outputs;
    State<2> &state;
    std::uint64_t n_done     = 0; /**< steps of this process */
    std::uint64_t iterations = 0; /**< of the implicit solver */
    std::uint64_t cuts       = 0; /**< of steps of the implicit solver */

    /** Residual of the energy balance, by the energy throughput [-]. */
    double energy_residual() const;
    /** For the progress; @p fraction of the stage that is done, or -1. */
    ProgressFigures progress_figures(const StageParameters &stage,
                                     double fraction) const;
  };

  /** How a stage of a problem of blocks goes on; members are collective. */
  class BlockStage
  {
  public:
    virtual ~BlockStage() = default;

    /** Model and solver begin the stage, or go on within it. */
    virtual void begin()                    = 0;
    virtual void resume()                   = 0;
    virtual bool is_over() const            = 0;
    virtual Problem::Checkpoint take_step() = 0;
    virtual ProgressFigures figures() const = 0;
    /** Called once the stage is over. */
    virtual void end()
    {
    }
  };

  /**
   * Whether a static @p stage is over: the unbalanced ratio, which was found in
   * this step, is small and its loads rest.
   */
  bool has_settled(const BlockContext &context, const StageParameters &stage);
} // namespace quoin

#endif
