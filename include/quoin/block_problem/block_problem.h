// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_block_problem_h
#define quoin_block_problem_block_problem_h

#include <quoin/block_problem/block_stage.h>
#include <quoin/block_problem/state_gathering.h>

namespace quoin
{
  /** Jointed blocks, by the explicit or implicit solver; in three dimensions
      blocks by the explicit one. */
  template <int dim>
  class BlockProblem : public Problem
  {
  public:
    /** @p mesh is on the first rank. */
    BlockProblem(const Parameters &parameters, MeshData<dim> mesh,
                 const RunContext &run);

    const std::string &fingerprint() const override;
    unsigned int n_stages() const override;
    std::unique_ptr<Stage> make_stage(unsigned int index) override;
    void restore(unsigned int index) override;
    void open_outputs() override;
    void summarise(nlohmann::ordered_json &summary,
                   double seconds) const override;
    ClosingLines
    closing_lines(const nlohmann::ordered_json &summary) const override;
    void complete_state() override;
    void save(boost::archive::binary_oarchive &archive) override;
    void load(boost::archive::binary_iarchive &archive,
              const ArchiveOrigin &origin) override;

  private:
    void report_model() override;
    void report_costs() override;
    /** Reports the time step of each stage, or its number of degrees of
        freedom, and warnings; throws an InputError about wrong stages. */
    void report_stages();
    /** Says what mass scaling changes in stage @p index, which has begun. */
    void report_added_mass(unsigned int index);
    /** Warns of likely mistakes, once stage @p index has begun with the state
        @p begun. */
    void advise_about_stage(unsigned int index, const State<dim> &begun) const;
    void summarise_searches(nlohmann::ordered_json &summary) const;
    void summarise_outcomes(nlohmann::ordered_json &summary) const;
    /** Adds the share of each phase in the time. Collective. */
    void summarise_contacts(nlohmann::ordered_json &summary,
                            double seconds) const;
    void summarise_bandwidth(nlohmann::ordered_json &summary,
                             double seconds) const;
    /** Whether a result with a large energy residual can be used, and what to
        change. */
    std::string residual_advice() const;

    /** Archives what a resumed run needs, @p archived in place of state. */
    template <typename Archive>
    void archive_all(Archive &archive, State<dim> &archived);

    BlockContext<dim> context;
    BlockSystem<dim> &system;
    State<dim> &state;
    /** Used while archives of another number of ranks are read. */
    std::unique_ptr<StateGathering<dim>> gathering;
  };

  // Members that exist in two dimensions only.
  template <>
  void BlockProblem<2>::summarise_contacts(nlohmann::ordered_json &summary,
                                           double seconds) const;
} // namespace quoin

#endif
