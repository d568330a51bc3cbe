// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_block_outputs_h
#define quoin_problems_block_outputs_h

#include <quoin/problems/block_system.h>
#include <quoin/problems/problem.h>
#include <quoin/results/boundary_output.h>
#include <quoin/results/histories.h>
#include <quoin/results/model_output.h>

namespace quoin
{
  /** Tables and fields of a problem of blocks; members are collective. */
  class BlockOutputs
  {
  public:
    /** @p system must outlive this object. */
    BlockOutputs(BlockSystem &system, const RunContext &run);

    /** Begins the files, or goes on with those of a checkpoint. */
    void open();

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
    /** Whether a row needs the unbalanced ratio of its own step. */
    bool row_needs_balance() const
    {
      return histories.need_balance();
    }

    /** Called before the step whose row is due. */
    void before_row(const State<2> &state)
    {
      histories.before_step(state);
    }
    /**
     * Rows of histories, energies and far field for the time before the last
     * step. Throws a RunError if the boundary elements have created energy.
     */
    void write_row(const State<2> &state);
    /** Rows of convergence.csv for the iterations since the last call. */
    void write_iterations();

    /** Fields of the time of @p state, once. */
    void write_fields(const State<2> &state);
    /** The failing @p state with displacements since @p base: mechanism/. */
    void write_mechanism(const State<2> &state, const State<2> &base,
                         double factor);

    /** Stops all ranks if the first one could not write a table. */
    void check_tables()
    {
      run.tables.check();
    }
    /** Numbers in a row of all tables together. */
    std::size_t n_columns() const;
    /** Largest residual of the energy balance so far [J]. */
    double largest_residual() const
    {
      return most_residual;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &fields &boundary &most_residual &largest_throughput &fields_time;
    }

  private:
    /** Does @p task and books its time as output. */
    template <typename Task>
    void measured(const Task &task)
    {
      PhaseClock &clock = system.solver->time_spent();
      clock.measure(clock.phase("output"), task);
    }
    void add_rows(const State<2> &state);
    void write_generated_geometry() const;
    void write_energies(double time);
    void write_far_field_row(const State<2> &state);
    void write_boundary(const State<2> &state);

    BlockSystem &system;
    const RunContext &run;
    Histories histories;
    const TimeControl row_times, field_times;
    RootTable &history_table, &energy_table;
    RootTable *far_field_table = nullptr, *convergence_table = nullptr;
    ModelOutput fields;
    BoundaryOutput boundary;

    double most_residual      = 0.;
    double largest_throughput = 0.;  /**< boundary elements' too [J] */
    double fields_time        = -1.; /**< of the last VTU files [s] */
  };
} // namespace quoin

#endif
