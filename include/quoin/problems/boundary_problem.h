// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_boundary_problem_h
#define quoin_problems_boundary_problem_h

#include <quoin/problems/boundary_system.h>
#include <quoin/problems/domain_results.h>
#include <quoin/problems/problem.h>
#include <quoin/results/boundary_output.h>
#include <quoin/tdbem/time_marching.h>

#include <memory>
#include <optional>
#include <vector>

namespace quoin
{
  /**
   * Boundary elements alone. The first stage marches in time, or writes the
   * static solution. What happens in the domain is computed in a second one,
   * from the record of all steps on the boundary. All ranks march alike; they
   * share the history and the points in the domain.
   */
  class BoundaryProblem : public Problem
  {
  public:
    /** @p parameters and @p run must outlive this object. */
    BoundaryProblem(const Parameters &parameters, const RunContext &run);

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
    /** What a checkpoint holds. */
    struct State
    {
      std::uint64_t step = 0;      /**< steps taken */
      std::vector<double> history; /**< what BoundaryHistory::save() gives */
      std::vector<double> u, p;    /**< scattered, of the last step */
      std::vector<double> all_u;   /**< of all steps, one unknown after the */
      std::vector<double> all_p;   /**< other, if the domain is asked for */
      std::vector<double> rows;    /**< of histories.csv that still lack */
                                   /**< what happens in the domain */

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &step &history &u &p &all_u &all_p &rows;
      }
    };

    void report_steps();
    void solve_static();
    void write_static();
    void make_march();
    void march_on();
    /** The row and the fields of the last step, if they are due. */
    void write_step(const Eigen::VectorXd &u_incident,
                    const Eigen::VectorXd &p_incident);
    void write_boundary(double time, const BoundaryState &fields);
    void write_row(double time, const BoundaryState &fields);

    const Parameters &parameters;
    const BoundaryElementParameters &settings;
    const RunContext &run;
    BoundarySystem system;
    const StepControl control;
    RootTable &history_table;
    BoundaryOutput boundary_output;
    State state;

    std::optional<StaticSolution> solution; /**< of statics */
    double solution_seconds = 0.;
    std::unique_ptr<TimeMarching> march;
    Eigen::VectorXd last_displacement; /**< total [m] */
    std::uint64_t n_done = 0;          /**< steps of this process */
    double march_seconds = 0.;         /**< of these steps */

    DomainResults domain;
    bool in_domain    = false; /**< the second stage is under way */
    bool has_solution = false; /**< the static one is written */
  };
} // namespace quoin

#endif
