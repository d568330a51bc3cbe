// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_safety_stage_h
#define quoin_problems_safety_stage_h

#include <quoin/problems/block_stage.h>

namespace quoin
{
  /**
   * A stage that finds the factor of safety: a step is the trial of a factor,
   * by which strengths are divided. Every trial begins with the state that the
   * stage found, and so does the stage after it.
   */
  class SafetyStage : public BlockStage
  {
  public:
    /** Stage @p index of the parameters; @p search: of this stage so far. */
    SafetyStage(BlockContext &context, unsigned int index,
                FactorSearch &search);

    void begin() override
    {
    }
    void resume() override;
    bool is_over() const override
    {
      return search.is_over(safety);
    }
    Problem::Checkpoint take_step() override;
    ProgressFigures figures() const override;
    void end() override;

  private:
    /** Strengths are those of the stage's begin, divided by @p factor. */
    void set_strength(double factor);
    SafetyTrial try_factor(double factor);
    void come_to_rest(SafetyTrial &trial);
    void find_equilibrium(SafetyTrial &trial);
    /** Since the stage's begin, of the whole model [m]; collective. */
    double largest_displacement() const;
    void write_table() const;

    BlockContext &context;
    const unsigned int index;
    const StageParameters &stage;
    const SafetyParameters &safety;
    FactorSearch &search;
    State<2> &state;
    const State<2> base;
    ModelProperties strong;
  };
} // namespace quoin

#endif
