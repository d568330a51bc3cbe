// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_block_problem_h
#define quoin_problems_block_problem_h

#include <quoin/problems/block_stage.h>

#include <memory>
#include <vector>

namespace quoin
{
  /** Blocks on joints, in motion or in equilibrium. */
  class BlockProblem : public Problem
  {
  public:
    /** @p parameters and @p run must outlive this object. */
    BlockProblem(const Parameters &parameters, const RunContext &run);

    std::string fingerprint() const override;
    unsigned int n_stages() const override;
    void report() override;
    void open_outputs() override;
    void resume(unsigned int stage, bool has_begun) override;
    void begin_stage(unsigned int stage) override;
    bool stage_is_over() const override;
    void end_stage() override;
    Checkpoint take_step() override;
    ProgressFigures progress_figures() const override;
    void summarise(nlohmann::json &summary, double seconds) const override;
    void report_end(const nlohmann::json &summary) override;
    void complete_state() override;
    void save(boost::archive::binary_oarchive &archive) override;
    void load(boost::archive::binary_iarchive &archive) override;

  private:
    void make_stage(unsigned int index);
    void warn_of_slip() const;
    void summarise_searches(nlohmann::json &summary) const;
    /** Of each phase its share of the time. Collective. */
    void summarise_time(nlohmann::json &summary, double seconds) const;
    void summarise_contacts(nlohmann::json &summary, double seconds) const;
    void warn_of_residual() const;

    /** Archives all that a resumed run needs. */
    template <typename Archive>
    void archive_all(Archive &archive);

    const Parameters &parameters;
    const RunContext &run;
    BlockSystem system;
    StageSteps steps;
    BlockOutputs outputs;
    State<2> state;
    BlockContext context;
    std::vector<FactorSearch> searches; /**< of each stage, most unused */
    std::unique_ptr<BlockStage> stage;  /**< under way; null: none yet */
  };
} // namespace quoin

#endif
