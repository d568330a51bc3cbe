// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_block_outputs_h
#define quoin_block_problem_block_outputs_h

#include <quoin/block_problem/block_system.h>
#include <quoin/problems/problem.h>
#include <quoin/results/boundary_output.h>
#include <quoin/results/histories.h>
#include <quoin/results/model_output.h>

namespace quoin
{
  /** Largest energies so far [J]. */
  struct LargestEnergies
  {
    double residual   = 0.; /**< of the energy balance */
    double throughput = 0.;
    double kinetic    = 0.;
  };

  /** Tables and fields of a problem of blocks; members are collective. */
  template <int dim>
  class BlockOutputs
  {
  public:
    /** @p system must outlive this object. */
    BlockOutputs(BlockSystem<dim> &system, const RunContext &run);

    /** Begins the files, or continues those of a checkpoint. */
    void open();

    /** Counts what @p reset names from @p state on, where a stage begins. */
    void begin_stage(const ResultReset &reset, State<dim> &state);
    /** Notes joints that fail as a stage ends; see note_failed_joints(). */
    void end_stage(State<dim> &state);

    /** Whether a row or fields are due at @p time [s], with steps of @p dt [s].
     */
    bool row_is_due(double time, double dt) const
    {
      return row_times.is_due(time, dt);
    }
    bool fields_are_due(double time, double dt) const
    {
      return field_times.is_due(time, dt);
    }
    const Histories<dim> &histories() const
    {
      return all_histories;
    }

    /** Called before the step whose row is due. */
    void before_row(const State<dim> &state)
    {
      all_histories.before_step(state);
    }
    /**
     * Writes rows of histories, energies and far field for the time before the
     * last step; returns that of histories. Throws a RunError if boundary
     * elements have created energy.
     */
    std::vector<double> write_row(const State<dim> &state);
    /** Writes a row of blocks_outside.csv; returns the histories that are of
        the @p block and so have no value any more if it is deleted. */
    std::vector<std::string> write_block_outside(const BlockOutside &block);
    /** Writes rows of convergence.csv for iterations since the last call. */
    void write_iterations();

    /** Writes the fields of @p state, once for each time. */
    void write_fields(const State<dim> &state);

    /** Numbers in a row of all tables together. */
    std::size_t n_columns() const;
    const LargestEnergies &largest() const
    {
      return most;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &fields &boundary &all_histories &most.residual &most
          .throughput &most.kinetic &largest_throughput &fields_time;
    }

  private:
    /** Runs @p task and books its time as output. */
    template <typename Task>
    void measured(const Task &task)
    {
      PhaseClock &clock = system.solver->time_spent();
      clock.measure(clock.phase("output"), task);
    }
    std::vector<double> add_rows(const State<dim> &state);
    /** Changes what results count from by @p change, which sees @p state with
        the internal variables of its positions, see ModelOutput. */
    template <typename Change>
    void change_origin(State<dim> &state, const Change &change);
    void write_generated_geometry() const;
    void write_energies(double time);
    void write_far_field_row(const State<dim> &state);
    void write_water_row(double time, const State<dim> &state);
    void write_boundary(const State<dim> &state);

    BlockSystem<dim> &system;
    const RunContext &run;
    const bool resets; /**< whether a stage has a ResultReset */
    Histories<dim> all_histories;
    const TimeControl row_times, field_times;
    RootTable &history_table, &energy_table;
    RootTable *far_field_table = nullptr, *convergence_table = nullptr,
              *outside_table = nullptr, *water_table = nullptr;
    ModelOutput<dim> fields;
    BoundaryOutput boundary;

    LargestEnergies most;
    double largest_throughput = 0.;  /**< boundary elements' too [J] */
    double fields_time        = -1.; /**< time of the last VTU files [s] */
  };

  // Members that exist in two dimensions only.
  template <>
  void BlockOutputs<2>::write_far_field_row(const State<2> &state);
  template <>
  void BlockOutputs<2>::write_water_row(double time, const State<2> &state);
  template <>
  void BlockOutputs<2>::write_boundary(const State<2> &state);
} // namespace quoin

#endif
