// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/gmsh_reader.h>
#include <quoin/problems/block_outputs.h>
#include <quoin/results/atomic_file.h>
#include <quoin/results/field_output.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /**
     * Energy that boundary elements may seem to have created, by what went
     * through the model. No domain that was at rest gives energy; the first
     * moments of a pulse, too short for the elements, may look so by a tenth.
     * Modes that grow soon owe all they have to the boundary elements.
     */
    constexpr double largest_created_share = 0.5;

    /** Energies that the model could give back and the accounts, dissipated
        ones first. */
    std::vector<std::string> energy_columns()
    {
      std::vector<std::string> names
          = { "time [s]", "kinetic [J]", "strain [J]", "joint [J]" };
      for (const EnergyAccount &account : energy_accounts)
      {
        if (account.kind == EnergyKind::given)
          names.push_back("far field [J]");
        names.push_back(account.name + std::string(" [J]"));
      }
      names.push_back("residual [J]");
      return names;
    }

    Histories make_histories(const BlockSystem &system)
    {
      const Parameters &parameters = system.parameters;
      return naming(parameters.file,
                    [&]()
                    {
                      return Histories(
                          parameters.histories, *system.model, *system.solver,
                          system.boundary_geometry, parameters.boundary,
                          system.construction->absent_in_the_end());
                    });
    }
  } // namespace

  BlockOutputs::BlockOutputs(BlockSystem &system, const RunContext &run)
    : system(system), run(run), histories(make_histories(system)),
      row_times(system.parameters.row_times()),
      field_times(system.parameters.field_times()),
      history_table(run.tables.add("histories.csv", histories.column_names())),
      energy_table(run.tables.add("energies.csv", energy_columns())),
      fields(run.output, *system.model, *system.solver),
      boundary(run.output, MPI_COMM_SELF)
  {
    if (system.solver->far_field())
      far_field_table = &run.tables.add(
          "far_field.csv",
          { "time [s]", "steps [-]", "radiated [J]", "substeps [J]",
            "incident [J]", "given [J]", "mismatch [-]" });
    if (system.implicit_solver)
      convergence_table = &run.tables.add(
          "convergence.csv", { "step [-]", "attempt [-]", "iteration [-]",
                               "load time [s]", "unbalanced ratio [-]",
                               "line search [-]", "linear iterations [-]" });
  }

  void BlockOutputs::open()
  {
    run.on_first_rank(
        [&]()
        {
          if (system.solver->far_field())
            boundary.start();
          if (!run.options.resume)
            write_generated_geometry();
        });
    fields.start();
  }

  void BlockOutputs::write_generated_geometry() const
  {
    const GeneratedGeometry &made = system.parameters.generated;
    if (made.geometry.empty())
      return;
    const std::string begin = run.output + "/" + made.name;
    write_text(begin + ".geo", made.geometry);
    if (!made.statistics.empty())
      write_text(begin + "_statistics.csv", made.statistics);
    write_gmsh_mesh(begin + ".geo", begin + ".msh",
                    system.parameters.triangles);
  }

  std::size_t BlockOutputs::n_columns() const
  {
    return energy_columns().size() + histories.column_names().size();
  }

  void BlockOutputs::write_row(const State<2> &state)
  {
    measured([&]() { add_rows(state); });
  }

  void BlockOutputs::add_rows(const State<2> &state)
  {
    const auto row = histories.after_step(state);
    write_energies(row.front());
    history_table.add_row(row);
    if (far_field_table)
      write_far_field_row(state);
  }

  void BlockOutputs::write_energies(const double time)
  {
    const Energies &energies = system.solver->energies();
    most_residual = std::max(most_residual, std::abs(energies.residual()));
    std::vector<double> row
        = { time, energies.kinetic, energies.strain, energies.joint };
    for (const EnergyAccount &account : energy_accounts)
    {
      if (account.kind == EnergyKind::given)
        row.push_back(energies.far_field);
      row.push_back(energies.accounts.*account.value);
    }
    row.push_back(energies.residual());
    energy_table.add_row(row);
  }

  void BlockOutputs::write_far_field_row(const State<2> &state)
  {
    const FarField::Ledger ledger = system.solver->far_field()->ledger(state);
    const double taken            = ledger.radiated + ledger.given;
    largest_throughput            = std::max(
                   { largest_throughput, std::abs(ledger.radiated), std::abs(ledger.given),
                     system.solver->energies().throughput() });
    if (taken < -largest_created_share * largest_throughput)
      throw RunError(
          text_of("the boundary elements have created energy, ", -taken,
                  " J of an energy throughput of ", largest_throughput,
                  " J: their discrete impedance is not passive. Change 'Step "
                  "ratio' or 'Formulation' in section 'Boundary elements' "
                  "until the passivity scan finds nothing, or damp the "
                  "blocks."));
    far_field_table->add_row(
        { state.time, double(state.get<FarFieldState>().n_steps),
          ledger.radiated, ledger.substeps, ledger.incident, ledger.given,
          ledger.mismatch });
  }

  void BlockOutputs::write_iterations()
  {
    for (const IterationReport &report : system.implicit_solver->take_reports())
      convergence_table->add_row({ double(report.step), double(report.attempt),
                                   double(report.iteration), report.load_time,
                                   report.unbalanced_ratio, report.line_search,
                                   report.linear_iterations });
  }

  void BlockOutputs::write_fields(const State<2> &state)
  {
    if (state.time == fields_time)
      return;
    fields_time = state.time;
    measured([&]() { fields.write(state.time, state); });
    if (system.solver->far_field())
      write_boundary(state);
    run.tables.flush();
  }

  void BlockOutputs::write_boundary(const State<2> &state)
  {
    if (!system.solver->far_field_acts() || !state.get<FarFieldState>().active)
      return;
    const BoundaryState on_boundary
        = boundary_state(*system.solver->far_field(), state);
    run.on_first_rank(
        [&]()
        {
          boundary.write(state.time, boundary_fields(system.boundary_geometry,
                                                     on_boundary));
        });
  }

  void BlockOutputs::write_mechanism(const State<2> &state,
                                     const State<2> &base, const double factor)
  {
    ModelOutput mechanism(run.output + "/mechanism", *system.model,
                          *system.solver);
    mechanism.start();
    mechanism.write(factor, state, &base);
  }
} // namespace quoin
