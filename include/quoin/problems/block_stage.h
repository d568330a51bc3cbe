// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_block_stage_h
#define quoin_problems_block_stage_h

#include <quoin/problems/block_outputs.h>
#include <quoin/problems/stage_steps.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace quoin
{
  /** What the stages of a problem of blocks work on. */
  struct BlockContext
  {
    BlockContext(const Parameters &parameters, const RunContext &run);

    const RunContext &run;
    BlockSystem system;
    StageSteps steps;
    BlockOutputs outputs;
    State<2> state;
    std::vector<FactorSearch> searches; /**< of each stage, most unused */
    std::uint64_t n_done     = 0;       /**< steps of this process */
    std::uint64_t iterations = 0;       /**< of the implicit solver */
    std::uint64_t cuts       = 0;       /**< of steps of the implicit solver */

    /** Residual of the energy balance, by the energy throughput [-]. */
    double energy_residual() const;
  };

  /** What all stages of a problem of blocks have in common. */
  class BlockStage : public Stage
  {
  public:
    /** Stage @p index of the parameters. */
    BlockStage(BlockContext &context, unsigned int index);

    void end() override;

  protected:
    /** What a kind of stage has to do at its end. */
    virtual void finish()
    {
    }
    /** For the progress; @p fraction of the stage that is done, or -1. */
    ProgressFigures figures_at(double fraction) const;
    /** Share of the loads of an implicit stage that is reached [-]. */
    double load_share() const;
    /**
     * Whether a static stage is over: the unbalanced ratio, which was found in
     * this step, is small and its loads rest.
     */
    bool has_settled() const;

    BlockContext &context;
    BlockSystem &system;
    BlockOutputs &outputs;
    Log &log;
    const unsigned int index;
    const StageParameters &stage;
    State<2> &state;

  private:
    void warn_of_slip() const;
  };

  /** A stage of the explicit solver that ends by time or has settled. */
  std::unique_ptr<Stage> make_explicit_stage(BlockContext &context,
                                             unsigned int index);

  /** A stage of the implicit solver, from equilibrium to equilibrium. Throws a
      FailedStep if there is none. */
  std::unique_ptr<Stage> make_implicit_stage(BlockContext &context,
                                             unsigned int index);

  /**
   * A stage that finds the factor of safety: a step is the trial of a factor,
   * by which strengths are divided. Every trial begins with the state that the
   * stage found, and so does the stage after it.
   */
  std::unique_ptr<Stage> make_safety_stage(BlockContext &context,
                                           unsigned int index);
} // namespace quoin

#endif
