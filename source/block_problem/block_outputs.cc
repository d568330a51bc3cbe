// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/gmsh_reader.h>
#include <quoin/block_problem/block_outputs.h>
#include <quoin/output/atomic_file.h>
#include <quoin/results/field_output.h>
#include <quoin/results/result_origin.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace quoin
{
  namespace
  {
    /**
     * Largest apparent energy from boundary elements, by the energy throughput
     * [-]. A domain at rest gives no energy; at the start of a pulse too short
     * for the elements a tenth may appear. The energy of growing modes soon
     * comes entirely from the boundary elements.
     */
    constexpr double largest_created_share = 0.5;

    std::vector<std::string> energy_columns()
    {
      std::vector<std::string> names = { "time [s]" };
      for (const EnergyAccount &account : energy_accounts)
        names.push_back(account.name + std::string(" [J]"));
      names.push_back("residual [J]");
      return names;
    }

    template <int dim>
    Histories<dim> make_histories(const BlockSystem<dim> &system)
    {
      const Parameters &parameters = system.parameters;
      return naming(parameters.file,
                    [&]()
                    {
                      const auto absence
                          = system.construction
                                ? system.construction->absence()
                                : std::vector<double>(
                                    system.nodes->table().group_names.size());
                      return Histories<dim>(
                          parameters.histories, *system.model, *system.solver,
                          system.boundary_geometry, parameters.boundary,
                          absence, system.named_blocks);
                    });
    }
  } // namespace

  template <int dim>
  BlockOutputs<dim>::BlockOutputs(BlockSystem<dim> &system,
                                  const RunContext &run)
    : system(system), run(run),
      resets(std::any_of(
          system.parameters.stages.begin(), system.parameters.stages.end(),
          [](const StageParameters &stage) { return stage.reset.any(); })),
      all_histories(make_histories(system)),
      row_times(system.parameters.row_times()),
      field_times(system.parameters.field_times()),
      history_table(
          run.tables.add("histories.csv", all_histories.column_names())),
      energy_table(run.tables.add("energies.csv", energy_columns())),
      fields(run.output, *system.model, *system.solver,
             system.parameters.field_format),
      boundary(run.output, MPI_COMM_SELF, system.parameters.field_format)
  {
    run.log.messages(all_histories.moved_points());
    if (system.solver->loads().far.elastodynamic)
      far_field_table = &run.tables.add(
          "far_field.csv",
          { "time [s]", "steps [-]", "radiated [J]", "substeps [J]",
            "incident [J]", "given [J]", "mismatch [-]" });
    if (system.parameters.model.contact.has_box)
      outside_table = &run.tables.add("blocks_outside.csv",
                                      { "time [s]", "block [-]", "x [m]",
                                        "y [m]", "velocity x [m/s]",
                                        "velocity y [m/s]", "deleted [-]" });
    if constexpr (dim == 2)
      if (system.water)
      {
        std::vector<std::string> columns
            = { "time [s]", "inflow [m^3]", "outflow [m^3]", "stored [m^3]",
                "residual [m^3]" };
        for (const WaterBoundary &boundary : system.parameters.water.boundaries)
          columns.push_back(boundary.name + " [m^3/s]");
        water_table = &run.tables.add("flow.csv", columns);
      }
    if (system.implicit_solver)
      convergence_table = &run.tables.add(
          "convergence.csv", { "step [-]", "attempt [-]", "iteration [-]",
                               "load time [s]", "unbalanced ratio [-]",
                               "line search [-]", "linear iterations [-]" });
  }

  template <int dim>
  void BlockOutputs<dim>::open()
  {
    run.on_first_rank(
        [&]()
        {
          if (system.solver->loads().far.elastodynamic)
            boundary.start();
          if (!run.options.resume)
            write_generated_geometry();
        });
    fields.start();
  }

  template <int dim>
  void BlockOutputs<dim>::begin_stage(const ResultReset &reset,
                                      State<dim> &state)
  {
    if (!resets)
      return;
    change_origin(state, [&](State<dim> &now)
                  { count_from(*system.model, reset, now); });
    all_histories.begin_stage(reset, state);
  }

  template <int dim>
  void BlockOutputs<dim>::end_stage(State<dim> &state)
  {
    if (!resets)
      return;
    if (state.stage_step > 1)
      note_failed_joints(state);
    change_origin(state,
                  [&](State<dim> &now) { note_failed_joints<dim>(now); });
  }

  template <int dim>
  template <typename Change>
  void BlockOutputs<dim>::change_origin(State<dim> &state, const Change &change)
  {
    using Origin   = ResultOrigin<dim>;
    State<dim> now = state;
    system.solver->update_histories(now);
    change(now);
    state.template get<Origin>() = now.template get<Origin>();
  }

  template <int dim>
  void BlockOutputs<dim>::write_generated_geometry() const
  {
    const GeneratedGeometry &made = system.parameters.generated;
    if (made.geometry.empty())
      return;
    const std::string begin = run.output + "/" + made.name;
    write_text(begin + (made.is_mesh ? ".msh" : ".geo"), made.geometry);
    if (!made.statistics.empty())
      write_text(begin + "_statistics.csv", made.statistics);
    if (!made.is_mesh)
      write_gmsh_mesh(begin + ".geo", begin + ".msh", system.parameters.cells);
  }

  template <int dim>
  std::size_t BlockOutputs<dim>::n_columns() const
  {
    return energy_columns().size() + all_histories.column_names().size();
  }

  template <int dim>
  std::vector<double> BlockOutputs<dim>::write_row(const State<dim> &state)
  {
    std::vector<double> row;
    measured([&]() { row = add_rows(state); });
    return row;
  }

  template <int dim>
  std::vector<double> BlockOutputs<dim>::add_rows(const State<dim> &state)
  {
    const auto row = all_histories.after_step(state);
    write_energies(row.front());
    history_table.add_row(row);
    if constexpr (dim == 2)
    {
      if (far_field_table)
        write_far_field_row(state);
      if (water_table)
        write_water_row(row.front(), state);
    }
    return row;
  }

  template <int dim>
  void BlockOutputs<dim>::write_energies(const double time)
  {
    const Energies &energies = system.solver->energies();
    most.residual   = std::max(most.residual, std::abs(energies.residual()));
    most.throughput = std::max(most.throughput, energies.throughput());
    most.kinetic    = std::max(most.kinetic, energies.kinetic);
    std::vector<double> row = { time };
    for (const EnergyAccount &account : energy_accounts)
      row.push_back(energies.*account.value);
    row.push_back(energies.residual());
    energy_table.add_row(row);
  }

  template <>
  void BlockOutputs<2>::write_far_field_row(const State<2> &state)
  {
    const FarFieldState &far     = state.get<FarFieldState>();
    const FarFieldLedger &ledger = far.ledger;
    const double taken           = ledger.radiated + ledger.given;
    largest_throughput           = std::max(
                  { largest_throughput, std::abs(ledger.radiated), std::abs(ledger.given),
                    system.solver->energies().throughput() });
    // Before an incident wave arrives, the model has little more energy than
    // the precursor of the wave brings, of which numerical errors are a large
    // share. So the measure is the energy that the wave brings in the run.
    const double scale = std::max(largest_throughput,
                                  system.solver->loads().far.incident_energy);
    if (taken < -largest_created_share * scale)
      throw RunError(text_of(
          "the boundary elements have created energy, ", -taken, " J, where ",
          scale,
          " J go through the model or come with "
          "waves: their discrete impedance is not passive. Change "
          "'Step ratio' or 'Formulation' in section 'Boundary elements' "
          "until the passivity scan finds nothing, or damp the "
          "blocks."));
    far_field_table->add_row({ state.time, double(far.n_steps), ledger.radiated,
                               ledger.substeps, ledger.incident, ledger.given,
                               ledger.mismatch });
  }

  template <>
  void BlockOutputs<2>::write_water_row(const double time,
                                        const State<2> &state)
  {
    const auto &flow = state.get<JointFlowState>().boundary_flow;
    // The row is one of the start of a step.
    const FlowVolumes water = system.water->volumes(
        state, state.load_start() + state.load_time
                   - state.load_rate * (state.time - time));
    std::vector<double> row
        = { time, water.inflow, water.outflow, water.stored, water.residual };
    row.insert(row.end(), flow.begin(), flow.end());
    water_table->add_row(row);
  }

  template <int dim>
  std::vector<std::string>
  BlockOutputs<dim>::write_block_outside(const BlockOutside &block)
  {
    outside_table->add_row({ block.time, double(block.block), block.position[0],
                             block.position[1], block.velocity[0],
                             block.velocity[1], block.removed ? 1. : 0. });
    return block.removed ? all_histories.names_in(block.block)
                         : std::vector<std::string>();
  }

  template <int dim>
  void BlockOutputs<dim>::write_iterations()
  {
    for (const IterationReport &report :
         std::exchange(system.implicit_solver->record().iterations, {}))
      convergence_table->add_row({ double(report.step), double(report.attempt),
                                   double(report.iteration), report.load_time,
                                   report.unbalanced_ratio, report.line_search,
                                   report.linear_iterations });
  }

  template <int dim>
  void BlockOutputs<dim>::write_fields(const State<dim> &state)
  {
    if (state.time == fields_time)
      return;
    fields_time = state.time;
    measured([&]() { fields.write(state.time, state); });
    if constexpr (dim == 2)
      if (system.solver->loads().far.elastodynamic)
        write_boundary(state);
    run.tables.flush();
  }

  template <>
  void BlockOutputs<2>::write_boundary(const State<2> &state)
  {
    if (!system.solver->loads().far.elastodynamic_acts
        || !state.get<FarFieldState>().active)
      return;
    const BoundaryState on_boundary
        = boundary_state(*system.solver->loads().far.elastodynamic, state);
    run.on_first_rank(
        [&]()
        {
          boundary.write(state.time, boundary_fields(system.boundary_geometry,
                                                     on_boundary));
        });
  }

  template class BlockOutputs<2>;
  template class BlockOutputs<3>;
} // namespace quoin
