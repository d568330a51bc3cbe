// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_explicit_stage_h
#define quoin_problems_explicit_stage_h

#include <quoin/problems/block_stage.h>

namespace quoin
{
  /** A stage of the explicit solver that ends by time or has settled. */
  class ExplicitStage : public BlockStage
  {
  public:
    /** Stage @p index of the parameters. */
    ExplicitStage(BlockContext &context, unsigned int index);

    void begin() override;
    void resume() override;
    bool is_over() const override
    {
      return over;
    }
    Problem::Checkpoint take_step() override;
    ProgressFigures figures() const override;

  private:
    /** The step is chosen, and a stage may be over before it. */
    void prepare();
    /** Whether the stage's last row is due at the next step. */
    bool may_be_last(bool balance) const;
    /** Of a stage that slows its loads, whether it ends at @p load_time [s]. */
    bool loads_are_over(double load_time) const;
    /** Of a stage that ends by time. */
    bool time_is_over() const;
    /** Throws a RunError if the stage has taken too many steps. */
    bool ends_here(bool balance) const;
    void report_blocks_outside();

    BlockContext &context;
    const unsigned int index;
    const StageParameters &stage;
    State<2> &state;
    ExplicitSolver &solver;
    bool over = false;
  };
} // namespace quoin

#endif
