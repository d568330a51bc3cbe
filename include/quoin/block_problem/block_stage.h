// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_block_stage_h
#define quoin_block_problem_block_stage_h

#include <quoin/dynamics/state_checks.h>
#include <quoin/block_problem/block_outputs.h>
#include <quoin/block_problem/load_record.h>
#include <quoin/block_problem/stage_steps.h>
#include <quoin/results/history_conditions.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace quoin
{
  /** Outcome and end time of a stage. */
  struct StageOutcome
  {
    std::string outcome;     /**< empty: it has not ended */
    std::string condition;   /**< condition that was met, or empty */
    double time        = 0.; /**< [s] */
    std::uint64_t step = 0;  /**< step number of the run */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &outcome &condition &time &step;
    }
  };

  /**
   * How much of the applied forces local damping opposes in a stage: at most
   * its coefficient times the unbalanced ratio. Blocks that move steadily have
   * that as a force against their motion, which is missing in reactions.
   */
  struct LocalDampingShare
  {
    /** Share above which reactions may be some per cent off [-]; measured:
        theory.md, "Damping". */
    static constexpr double large = 0.005;

    double sum      = 0.;
    std::uint64_t n = 0, n_large = 0; /**< samples, and those above large */
    /** Share of the energy throughput that is kinetic above which something
        falls or flies, rows of histories, and those with more. */
    static constexpr double moving = 0.05;
    std::uint64_t n_rows = 0, n_moving = 0;

    void add(const double share)
    {
      sum += share;
      ++n;
      n_large += share > large;
    }
    void add_row(const double kinetic_share)
    {
      ++n_rows;
      n_moving += kinetic_share > moving;
    }
    /** Whether it was large for more than half of the stage: not only while it
        settles, or as joints break. */
    bool is_large() const
    {
      return 2 * n_large > n;
    }
    /** Whether something moved fast for longer than loads that are suddenly
        applied make it. */
    bool is_of_motion() const
    {
      return n_moving >= 10 && 20 * n_moving > n_rows;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &sum &n &n_large &n_rows &n_moving;
    }
  };

  /** Data of the stages of a problem of blocks. */
  template <int dim>
  struct BlockContext
  {
    /** @p mesh is on the first rank. */
    BlockContext(const Parameters &parameters, MeshData<dim> mesh,
                 const RunContext &run);

    const RunContext &run;
    BlockSystem<dim> system;
    StageSteps<dim> steps;
    BlockOutputs<dim> outputs;
    State<dim> state;
    /** Search of each stage, most unused. */
    std::vector<FactorSearch> searches;
    std::vector<StageOutcome> outcomes; /**< outcome of each stage */
    std::vector<LoadRecord> loads;      /**< load record of each stage */
    /** Local damping of each stage. */
    std::vector<LocalDampingShare> damping_shares;
    std::vector<double> peaks; /**< peaks of histories: see HistoryConditions */
    double displaced = 0.;     /**< largest one where the stage began [m] */
    /** Largest motions of joints in the present stage, if displacements are
        small. */
    JointMotion joint_motion;
    std::string failure; /**< why the last stage failed; empty: it did not */
    std::uint64_t n_done = 0; /**< steps of this process */
    /** Number of iterations of the implicit solver. */
    std::uint64_t iterations = 0;
    /** Number of step reductions of the implicit solver. */
    std::uint64_t cuts = 0;

    /** Energy below which residuals may be rounding [J]. */
    double rounding = 0.;

    /** Raises #rounding by the loads that act now; collective. */
    void note_rounding();

    /** Residual of the energy balance, by the largest energy throughput so
        far [-]. */
    double energy_residual() const;
  };

  /** Base of all stages of a problem of blocks. */
  template <int dim>
  class BlockStage : public Stage
  {
  public:
    /** Stage @p index of the parameters. */
    BlockStage(BlockContext<dim> &context, unsigned int index);

    void end() override;

  protected:
    /** Model, solver and what results count from begin the stage. */
    void begin_model();
    /** Tasks of a kind of stage at its end. */
    virtual void finish()
    {
    }
    /** Called before the step whose row is due. */
    void before_row();
    /** Writes a row and looks whether a condition ends the stage. */
    void write_row();
    /** Whether a condition has been met. */
    bool is_to_end() const
    {
      return !context.outcomes[index].outcome.empty();
    }
    /** Writes the fields and throws a FailedStep. */
    [[noreturn]] void fail(const std::string &why);
    /** Follows the motions of joints if displacements are small; fails if
        they are absurd. Collective. */
    void follow_joint_motion();
    /** Progress, with the completed @p fraction of the stage, or -1. */
    ProgressFigures figures_at(double fraction) const;
    /** Share of the loads of an implicit stage that has been reached [-]. */
    double load_share() const;
    /**
     * Whether a static stage has ended: the unbalanced ratio, computed in this
     * step, is small and its loads are constant.
     */
    bool has_settled() const;

    BlockContext<dim> &context;
    BlockSystem<dim> &system;
    BlockOutputs<dim> &outputs;
    Log &log;
    const unsigned int index;
    const StageParameters &stage;
    State<dim> &state;

  private:
    /** Warns of motions of joints for which displacements are not small. */
    void warn_of_joint_motion() const;
    /** Warns of beams that would buckle. */
    void warn_of_unstable_beams() const;
    /** Warns of beams whose axial force is beyond their strength, and of liners
        that it bends along the chords of a curve. */
    void warn_of_beam_forces() const;
    /** Warns of liners that the stage cuts from blocks that it excavates, with
        the number of points of each of them @p before. */
    void warn_of_cut_liners(const std::vector<unsigned int> &before) const;
    /** Warns if joints lost their bond while loads came on; collective. */
    void warn_of_lost_bond() const;
    /** Records the loads of the row for @p time [s]. */
    void record_loads(double time);
    /** Warns of local damping that has carried a part of the loads. */
    void warn_of_damping() const;
    /** Warns if the stage ends far from its control function. Collective. */
    void warn_of_control() const;
    /** Keeps and reports how the stage has ended. */
    void note_outcome();
    /** Forces of excavated blocks that a stage has not released when a
        condition ends it stay. */
    void keep_unreleased_forces();

    const HistoryConditions conditions; /**< conditions that end the stage */
    // Before the step whose row is due.
    double load_time  = 0.;    /**< [s] */
    double controlled = 0.;    /**< displacement by a load pattern [m] */
    bool is_first     = false; /**< step of the stage */
  };

  /** A stage of the explicit solver that ends by time or at rest. */
  template <int dim>
  std::unique_ptr<Stage> make_explicit_stage(BlockContext<dim> &context,
                                             unsigned int index);

  /** A stage of the implicit solver, from equilibrium to equilibrium. Throws a
      FailedStep if there is none. */
  template <int dim>
  std::unique_ptr<Stage> make_implicit_stage(BlockContext<dim> &context,
                                             unsigned int index);

  /**
   * A stage that finds the factor of safety: a step is the trial of a factor,
   * by which strengths are divided. Every trial begins with the state at the
   * start of the stage, and so does the next stage.
   */
  template <int dim>
  std::unique_ptr<Stage> make_safety_stage(BlockContext<dim> &context,
                                           unsigned int index);
} // namespace quoin

#endif
