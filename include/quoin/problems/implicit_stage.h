// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_implicit_stage_h
#define quoin_problems_implicit_stage_h

#include <quoin/problems/block_stage.h>

namespace quoin
{
  /** A stage of the implicit solver, from equilibrium to equilibrium. */
  class ImplicitStage : public BlockStage
  {
  public:
    /** Stage @p index of the parameters. */
    ImplicitStage(BlockContext &context, unsigned int index);

    void begin() override;
    void resume() override;
    bool is_over() const override
    {
      return solver.is_over(state);
    }
    /** Throws a FailedStep if there is no equilibrium. */
    Problem::Checkpoint take_step() override;
    ProgressFigures figures() const override;

  private:
    void advance();
    void write_row();

    BlockContext &context;
    const unsigned int index;
    const StageParameters &stage;
    State<2> &state;
    ImplicitSolver &solver;
  };

  /** Share of the loads of an implicit stage that is reached [-]. */
  double load_share(const BlockContext &context);
} // namespace quoin

#endif
