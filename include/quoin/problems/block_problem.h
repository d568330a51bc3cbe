// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_block_problem_h
#define quoin_problems_block_problem_h

#include <quoin/problems/block_stage.h>

namespace quoin
{
  /** Blocks on joints, in motion or in equilibrium. */
  class BlockProblem : public Problem
  {
  public:
    BlockProblem(const Parameters &parameters, const RunContext &run);

    const std::string &fingerprint() const override;
    unsigned int n_stages() const override;
    std::unique_ptr<Stage> make_stage(unsigned int index) override;
    void restore(unsigned int index) override;
    void open_outputs() override;
    void summarise(nlohmann::json &summary, double seconds) const override;
    LastWords last_words(const nlohmann::json &summary) const override;
    void complete_state() override;
    void save(boost::archive::binary_oarchive &archive) override;
    void load(boost::archive::binary_iarchive &archive) override;

  private:
    void report_model() override;
    void report_costs() override;
    /** The time step of each stage, or its unknowns, and warnings; finds what
        is wrong with stages. */
    void report_stages();
    /** Warns of what is likely a mistake, once stage @p index has begun with
        the state @p begun. */
    void advise_about_stage(unsigned int index, const State<2> &begun) const;
    void summarise_searches(nlohmann::json &summary) const;
    /** Of each phase its share of the time. Collective. */
    void summarise_time(nlohmann::json &summary, double seconds) const;
    void summarise_contacts(nlohmann::json &summary, double seconds) const;
    void summarise_bandwidth(nlohmann::json &summary, double seconds) const;

    /** Archives all that a resumed run needs. */
    template <typename Archive>
    void archive_all(Archive &archive);

    BlockContext context;
    BlockSystem &system;
    State<2> &state;
  };
} // namespace quoin

#endif
