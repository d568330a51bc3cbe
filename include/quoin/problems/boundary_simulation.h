// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_boundary_simulation_h
#define quoin_problems_boundary_simulation_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/results/boundary_histories.h>
#include <quoin/results/checkpoint_clock.h>
#include <quoin/farfield/boundary_values.h>
#include <quoin/farfield/incident_waves.h>
#include <quoin/problems/parameters.h>
#include <quoin/problems/run_options.h>
#include <quoin/base/time_control.h>
#include <quoin/results/boundary_output.h>
#include <quoin/results/log.h>
#include <quoin/results/output_lock.h>
#include <quoin/results/progress.h>
#include <quoin/results/root_table.h>
#include <quoin/tdbem/time_marching.h>
#include <quoin/tdbem/elastic_medium.h>
#include <quoin/tdbem/interior_points.h>
#include <quoin/tdbem/passivity.h>
#include <quoin/tdbem/static_solver.h>
#include <quoin/tdbem/tangential_stress.h>

#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * One run of boundary elements alone. The equations are solved for the
   * scattered field, that is, the total one without the incident waves; given
   * values and results are those of the total field. What happens in the
   * domain is computed at the end, from the record of the whole run on the
   * boundary. All ranks march alike; they share the history and the points in
   * the domain.
   */
  class BoundarySimulation
  {
  public:
    BoundarySimulation(const Parameters &parameters, const RunOptions &options,
                       MPI_Comm communicator);

    /** Throws InputError or RunError. */
    void run();

  private:
    /** What a checkpoint holds. */
    struct Record
    {
      std::uint64_t step = 0;      /**< steps taken */
      std::vector<double> history; /**< what BoundaryHistory::save() gives */
      std::vector<double> u, p;    /**< scattered, of the last step */
      std::vector<double> all_u;   /**< of all steps, one unknown after the */
      std::vector<double> all_p;   /**< other, if the domain is asked for */
      std::vector<double> rows;    /**< of histories.csv that still lack */
                                   /**< what happens in the domain */
      RootTable history_table;
      BoundaryOutput boundary_output;
      double wall_time = 0.; /**< of the time loop [s] */
      bool finished    = false;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &step &history &u &p &all_u &all_p &rows &history_table
            .n_bytes &boundary_output &wall_time &finished;
      }
    };

    void make_boundary();
    void make_sampled_points();
    void choose_time_step();
    void report();
    /** Warns of elements that are too long for what they are given. */
    void advise();
    /** Time, memory, disk; takes about half a second. */
    void report_costs();
    /** What all steps take, by some of them; spoils the history [s]. */
    double seconds_of_march();
    /** What points in the domain take, by one of them [s]. */
    double seconds_of_points() const;
    void make_operators();
    void report_stability();
    /** Also a half-plane, whose surface is discretised to a distance. */
    bool is_bounded() const;
    void open_outputs();
    void make_march();
    void solve_static();
    void write_static();
    void take_step();
    /** What is given in a step, without what incident waves have of it. */
    Eigen::VectorXd scattered_values(double begin, double end,
                                     const Eigen::VectorXd &u_incident,
                                     const Eigen::VectorXd &p_incident);
    void write_boundary(double time, const BoundaryState &state);
    void write_row(double time, const BoundaryState &state);
    void write_domain();
    void write_histories(const BoundaryRecord &all);
    void write_sampled_fields(const BoundaryRecord &all);
    void write_sampled_field(double time, const Eigen::VectorXd &displacement,
                             const Eigen::VectorXd &velocity);
    void checkpoint_if_due();
    void save_checkpoint();
    void write_summary();

    bool needs_record() const;
    /** Of histories and the sampled field. */
    std::vector<Eigen::Vector2d> points_in_domain() const;
    bool row_is_due(std::uint64_t step) const;
    bool fields_are_due(std::uint64_t step) const;
    /** Of points in the domain at the ends of some steps, total field. */
    Eigen::MatrixXd
    domain_displacements(const BoundaryRecord &all,
                         const std::vector<Eigen::Vector2d> &points,
                         const std::vector<unsigned int> &steps) const;
    ProgressFigures progress_figures() const;

    const Parameters parameters;
    const BoundaryElementParameters &settings;
    const RunOptions options;
    const MPI_Comm communicator;
    const bool is_first_rank;
    const std::string output;

    OutputLock lock;
    Log log;
    Progress progress;
    std::string run_identity; /**< what a resumed run must share */
    ElasticMedium medium{};
    BoundaryGeometry geometry;
    std::unique_ptr<IncidentWaves> waves;
    SampledFields sampled; /**< places and triangles */
    std::vector<Eigen::Vector2d> sampled_points;

    std::unique_ptr<BoundaryHistories> histories;
    std::unique_ptr<TangentialStress> hoop_stress;
    std::unique_ptr<BoundaryValues> given;
    std::unique_ptr<InfluenceKernel> kernel;
    std::unique_ptr<BoundaryHistory> history;
    std::unique_ptr<TimeMarching> march;
    SampledFieldOutput field_output;
    TimeControl history_control, field_control;
    Record record;

    double dt             = 0.; /**< [s] */
    std::uint64_t n_steps = 0;
    std::unique_ptr<PassivityReport> passivity;
    std::unique_ptr<StaticSolution> static_solution;
    Eigen::VectorXd last_displacement; /**< total [m] */
    std::uint64_t steps_done = 0;      /**< by this process */
    double seconds_done      = 0.;
    CheckpointClock checkpoint_clock;
  };
} // namespace quoin

#endif
