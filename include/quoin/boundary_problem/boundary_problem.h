// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_boundary_problem_boundary_problem_h
#define quoin_boundary_problem_boundary_problem_h

#include <quoin/boundary_problem/boundary_stage.h>

namespace quoin
{
  /**
   * Boundary elements alone. The first stage is the time marching, or writes
   * the static solution. Results in the domain are computed in a second one.
   */
  class BoundaryProblem : public Problem
  {
  public:
    BoundaryProblem(const Parameters &parameters, const RunContext &run);

    const std::string &fingerprint() const override;
    unsigned int n_stages() const override;
    std::unique_ptr<Stage> make_stage(unsigned int index) override;
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
    void report_steps();
    const BoundaryElementParameters &settings;
    BoundaryContext context;
    BoundarySystem &system;
  };
} // namespace quoin

#endif
