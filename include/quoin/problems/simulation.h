// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_simulation_h
#define quoin_problems_simulation_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/results/checkpoint_clock.h>
#include <quoin/results/histories.h>
#include <quoin/farfield/incident_waves.h>
#include <quoin/problems/parameters.h>
#include <quoin/problems/run_options.h>
#include <quoin/base/time_control.h>
#include <quoin/dynamics/construction.h>
#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/model.h>
#include <quoin/implicit/implicit_solver.h>
#include <quoin/mesh/block_mesh.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/results/block_output.h>
#include <quoin/results/boundary_output.h>
#include <quoin/results/joint_output.h>
#include <quoin/results/log.h>
#include <quoin/results/output_lock.h>
#include <quoin/results/progress.h>
#include <quoin/results/root_table.h>
#include <quoin/tdbem/passivity.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <memory>
#include <string>

namespace quoin
{
  /**
   * One run: reads mesh and parameters, takes the model through its stages
   * and writes the results. Owns all modules; reading run() gives the
   * architecture.
   */
  class Simulation
  {
  public:
    Simulation(const Parameters &parameters, const RunOptions &options,
               MPI_Comm communicator);

    /** Throws InputError or RunError. */
    void run();

  private:
    /** What a checkpoint holds: the state and how far the outputs are. */
    struct Record
    {
      State<2> state;
      RootTable history_table, energy_table;
      BlockOutput block_output;
      JointOutput joint_output;
      JointOutput contact_output;
      BoundaryOutput boundary_output;
      RootTable far_field_table   = {};
      double wall_time            = 0.;  /**< of the time loop [s] */
      double largest_residual     = 0.;  /**< of the energy balance */
      double largest_throughput   = 0.;  /**< boundary elements' too [J] */
      double fields_time          = -1.; /**< of the last VTU files [s] */
      bool stage_begun            = false;
      RootTable convergence_table = {};
      std::uint64_t iterations = 0, cuts = 0;  /**< of the implicit solver */
      std::vector<FactorSearch> searches = {}; /**< of each stage; or empty */

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &state &history_table.n_bytes &energy_table
            .n_bytes &block_output &joint_output &contact_output
                &boundary_output &far_field_table
            .n_bytes &wall_time &largest_residual &largest_throughput
                &fields_time &stage_begun &convergence_table
            .n_bytes &iterations &cuts &searches;
      }

      /** Those that are not made have no rows. */
      std::array<RootTable *, 4> tables()
      {
        return { &history_table, &energy_table, &far_field_table,
                 &convergence_table };
      }
    };

    void make_model();
    void make_solver(const MeshData &as_read);
    void set_initial_motion();
    void report_model();
    /** Sizes, and warnings of what is likely a mistake in the mesh. */
    void report_mesh();
    void report_initial_joints();
    /** Materials, joints and loads. */
    void report_parts();
    void advise(const std::vector<std::string> &advice);
    /** Of what is likely a mistake, once the stage has begun with @p state. */
    void advise_about_stage(unsigned int index, const State<2> &state);
    /** Time, memory, disk; takes about half a second. */
    void report_costs();
    void report_steps(const StageParameters &stage, const State<2> &start);
    /** From @p start again after the stage's end or a failure. */
    void take_trial_step(const StageParameters &stage, const State<2> &start,
                         State<2> &state);
    void report_iterations(unsigned int index, const State<2> &state);
    /**
     * Model and solver begin stage @p index with @p state; loads are not to
     * begin with a jump, as far as its time is known, @p time_is_known.
     */
    void begin_stage(unsigned int index, State<2> &state,
                     bool time_is_known = true);
    /** They go on with the state of a checkpoint. */
    void resume();
    void open_outputs();
    /** Tables of the first rank. */
    void make_tables();
    void run_stage(unsigned int index);
    void run_safety_stage(unsigned int index);
    /** Divides the strengths of @p strong by @p factor. */
    void set_strength(const ModelProperties &strong,
                      const SafetyParameters &safety, double factor);
    /** Of the model and of general contacts. */
    void set_properties(const ModelProperties &properties);
    /** @p base: the state before the stage. */
    SafetyTrial try_factor(const StageParameters &stage, double factor,
                           const State<2> &base);
    void come_to_rest(const StageParameters &stage, const State<2> &base,
                      SafetyTrial &trial);
    void find_equilibrium(const StageParameters &stage, SafetyTrial &trial);
    double largest_displacement(const State<2> &base) const;
    /** The failing state with displacements since @p base: mechanism/. */
    void write_mechanism(const State<2> &base, double factor);
    void report_safety(unsigned int index);
    void end_stage(unsigned int index);
    void report_implicit_model();
    void run_implicit_stage(unsigned int index);
    void take_implicit_step();
    void write_implicit_rows();
    void write_iterations();
    void choose_time_step(const StageParameters &stage);
    /**
     * Makes a step of the boundary elements a whole number of block steps not
     * longer than @p dt; returns these.
     */
    double choose_far_field_step(const StageParameters &stage, double dt);
    void make_waves(double step);
    void report_far_field();
    void write_far_field_row();
    void write_boundary();
    void warn_of_slip(const StageParameters &stage);
    /** Returns whether the stage is over. */
    bool take_step(const StageParameters &stage);
    void report_blocks_outside();
    /** Of a stage that slows its loads, whether it ends at @p load_time. */
    bool loads_are_over(const StageParameters &stage, double load_time) const;
    /** Of a stage that lasts for a given time. */
    bool time_is_over(const StageParameters &stage) const;
    bool stage_is_over(const StageParameters &stage, bool balance);
    bool has_settled(const StageParameters &stage, bool balance) const;
    /** .geo, .msh and statistics of blocks that were generated. */
    void write_generated_geometry() const;
    /** The row of @p time [s], that of the histories beside it. */
    void write_energies(double time);
    void write_fields();
    void save_checkpoint();
    void checkpoint_if_due();
    /** Stops all ranks if the first one could not write a table. */
    void check_tables();
    void write_summary(bool finished);
    /** Parts of the summary. */
    void summarise_searches(nlohmann::json &summary) const;
    void summarise_contacts(nlohmann::json &summary) const;
    void report_end(const nlohmann::json &summary);
    ProgressFigures progress_figures(const StageParameters &stage) const;
    double energy_residual() const;

    const Parameters parameters;
    const RunOptions options;
    const MPI_Comm communicator;
    const bool is_first_rank;
    const std::string output;

    OutputLock lock;
    Log log;
    Progress progress;
    std::string run_identity; /**< what a resumed run must share */
    BlockMesh<2> mesh;
    MeshReport mesh_report;
    std::unique_ptr<Model> model;
    std::unique_ptr<Construction> construction;
    BoundaryGeometry boundary_geometry;
    std::unique_ptr<IncidentWaves> waves;
    std::unique_ptr<Solver> solver;
    ExplicitSolver *explicit_solver = nullptr; /**< it, or null */
    ImplicitSolver *implicit_solver = nullptr; /**< it, or null */
    std::unique_ptr<Histories> histories;
    std::unique_ptr<PassivityReport> passivity;
    TimeControl history_control, field_control;
    Record record;

    std::uint64_t steps_of_stage = 0; /**< for stages that end by time */
    std::uint64_t steps_done     = 0; /**< by this process */
    double seconds_done          = 0.;
    CheckpointClock checkpoint_clock;
  };
} // namespace quoin

#endif
