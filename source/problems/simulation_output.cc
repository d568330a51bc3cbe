// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/bandwidth.h>
#include <quoin/results/field_output.h>
#include <quoin/problems/open_log.h>
#include <quoin/problems/simulation.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/results/atomic_file.h>
#include <quoin/results/checkpoint.h>
#include <quoin/results/collective.h>
#include <quoin/results/json_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace quoin
{
  void Simulation::make_tables()
  {
    if (!is_first_rank)
      return;
    record.history_table.make(output + "/histories.csv",
                              histories->column_names());
    record.energy_table.make(
        output + "/energies.csv",
        { "time [s]", "kinetic [J]", "strain [J]", "joint [J]", "friction [J]",
          "fracture [J]", "crushing [J]", "plastic [J]", "damping [J]",
          "viscous [J]", "contact [J]", "radiated [J]", "far field [J]",
          "external [J]", "residual [J]" });
    if (solver->far_field())
      record.far_field_table.make(output + "/far_field.csv",
                                  { "time [s]", "steps [-]", "radiated [J]",
                                    "substeps [J]", "incident [J]", "given [J]",
                                    "mismatch [-]" });
    if (implicit_solver)
      record.convergence_table.make(output + "/convergence.csv",
                                    { "step [-]", "attempt [-]",
                                      "iteration [-]", "load time [s]",
                                      "unbalanced ratio [-]", "line search [-]",
                                      "linear iterations [-]" });
  }

  void Simulation::open_outputs()
  {
    make_tables();
    open_log(run_identity, output, options.resume, communicator, lock, log,
             record);

    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            for (RootTable *table : record.tables())
                              if (options.resume)
                                table->resume();
                              else
                                table->start();
                            // After a resumption: cut back to what the
                            // checkpoint had.
                            if (solver->far_field())
                              record.boundary_output.start();
                            write_text(output + "/used_parameters.prm",
                                       parameters.effective);
                            if (!options.resume)
                              write_generated_geometry();
                          });
    record.block_output.start();
    record.joint_output.start();
    if (solver->contacts())
      record.contact_output.start();
  }

  void Simulation::write_generated_geometry() const
  {
    const GeneratedGeometry &made = parameters.generated;
    if (made.geometry.empty())
      return;
    write_text(output + "/" + made.name + ".geo", made.geometry);
    if (!made.statistics.empty())
      write_text(output + "/" + made.name + "_statistics.csv", made.statistics);
    write_gmsh_mesh(output + "/" + made.name + ".geo",
                    output + "/" + made.name + ".msh", parameters.triangles);
  }

  void Simulation::write_energies(const double time)
  {
    const Energies &energies       = solver->energies();
    const EnergyAccounts &accounts = energies.accounts;
    record.largest_residual
        = std::max(record.largest_residual, std::abs(energies.residual()));
    record.energy_table.add_row(
        { time, energies.kinetic, energies.strain, energies.joint,
          accounts.friction, accounts.fracture, accounts.crushing,
          accounts.plastic, accounts.damping, accounts.viscous,
          accounts.contact, accounts.radiated, energies.far_field,
          accounts.external, energies.residual() });
  }

  void Simulation::write_fields()
  {
    const State<2> &state = record.state;
    if (state.time == record.fields_time)
      return;
    record.fields_time = state.time;
    // Histories are those of the step before.
    State<2> now = state;
    solver->update_histories(now);
    record.block_output.write(state.time, block_fields(*model, now));
    record.joint_output.write(state.time, joint_fields(*model, now));
    if (solver->contacts())
      record.contact_output.write(state.time,
                                  contact_fields(*solver->contacts(), now));
    if (solver->far_field())
      write_boundary();
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            for (RootTable *table : record.tables())
                              table->flush();
                          });
  }

  void Simulation::check_tables()
  {
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            for (const RootTable *table : record.tables())
                              table->check();
                          });
  }

  void Simulation::checkpoint_if_due()
  {
    const bool looks
        = !explicit_solver
          || record.state.stage_step % CheckpointClock::steps_between_looks
                 == 0;
    if (looks && checkpoint_clock.is_due())
      save_checkpoint();
  }

  void Simulation::save_checkpoint()
  {
    solver->check_finite(record.state);
    solver->check_cells(record.state);
    solver->save(record.state);
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            for (RootTable *table : record.tables())
                              table->sync();
                          });
    quoin::save_checkpoint(
        output, communicator,
        { record.state.step, record.state.time, QUOIN_VERSION, run_identity },
        record);
    record.state.far_field.history.clear();
    record.state.implicit.before_jump.clear();
    checkpoint_clock.restart();
  }

  void Simulation::write_summary(const bool finished)
  {
    nlohmann::json summary
        = { { "title", parameters.title },
            { "version", QUOIN_VERSION },
            { "finished", finished },
            { "ranks", dealii::Utilities::MPI::n_mpi_processes(communicator) },
            { "blocks", mesh.n_blocks() },
            { "rigid blocks", std::count(model->is_rigid().begin(),
                                         model->is_rigid().end(), true) },
            { "cells", mesh.n_cells() },
            { "nodes", mesh.n_vertices() },
            { "joint faces", mesh.joint_faces.size() },
            { "joint length [m]", mesh_report.total_joint_length },
            { "shortest edge [m]", mesh_report.shortest_edge },
            { "smallest angle [deg]", mesh_report.smallest_angle },
            { "time [s]", record.state.time },
            { "steps", record.state.step },
            { "wall time [s]", record.wall_time },
            { "unbalanced ratio", record.state.unbalanced_ratio },
            { "energy throughput [J]", solver->energies().throughput() },
            { "energy residual [J]", solver->energies().residual() },
            { "largest energy residual [J]", record.largest_residual },
            { "energy residual share", energy_residual() } };
    if (explicit_solver)
    {
      summary["time step [s]"]          = explicit_solver->get_time_step();
      summary["critical time step [s]"] = explicit_solver->critical_time_step();
      summary["added mass share"]       = explicit_solver->added_mass_share();
      summary["element updates per second"]
          = seconds_done > 0.
                ? double(mesh.n_cells()) * double(steps_done) / seconds_done
                : 0.;
    }
    if (implicit_solver)
    {
      summary["unknowns"]   = implicit_solver->n_unknowns();
      summary["iterations"] = record.iterations;
      summary["cut steps"]  = record.cuts;
    }
    summarise_searches(summary);
    summary["solver"] = implicit_solver ? "implicit" : "explicit";
    if (parameters.model.contact.has_box)
    {
      const auto &marks = record.state.block_marks;
      summary["blocks deleted"]
          = std::count(marks.begin(), marks.end(), block_mark::removed);
      summary["blocks outside the box"]
          = std::count(marks.begin(), marks.end(), block_mark::left_box);
    }
    if (solver->contacts())
      summarise_contacts(summary);
    if (finished && parameters.measure_bandwidth)
    {
      const double bytes    = step_bytes(mesh.n_vertices(), mesh.n_cells());
      const double measured = dealii::Utilities::MPI::sum(
          memory_bandwidth(
              bytes / dealii::Utilities::MPI::n_mpi_processes(communicator)),
          communicator);
      const double used = bytes * double(steps_done) / seconds_done;
      summary["memory bandwidth [B/s]"]    = measured;
      summary["share of memory bandwidth"] = used / measured;
    }
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                              write_json(output + "/summary.json", summary);
                          });
    if (finished)
      report_end(summary);
  }

  void Simulation::summarise_searches(nlohmann::json &summary) const
  {
    for (unsigned int i = 0; i < record.searches.size(); ++i)
      if (parameters.stages[i].safety
          && std::isfinite(record.searches[i].lowest_failing()))
      {
        const FactorSearch &search = record.searches[i];
        auto &found = summary["factor of safety"][parameters.stages[i].name];
        found["stable at"]  = search.highest_stable();
        found["failing at"] = search.lowest_failing();
        found["trials"]     = search.trials().size();
      }
  }

  void Simulation::summarise_contacts(nlohmann::json &summary) const
  {
    const BlockContacts *contacts = solver->contacts();
    const double sums[3]
        = { contacts->n_touching(record.state.contacts),
            double(contacts->n_updates()), contacts->search_seconds() };
    std::array<double, 3> all;
    MPI_Allreduce(sums, all.data(), 3, MPI_DOUBLE, MPI_SUM, communicator);
    summary["contacts"] = all[0];
    summary["contact updates per second"]
        = seconds_done > 0. ? all[1] / seconds_done : 0.;
    summary["contact searches"] = record.state.contacts.n_searches;
    // Ranks search together: the mean of their times counts.
    summary["contact search share"]
        = seconds_done > 0.
              ? all[2] / dealii::Utilities::MPI::n_mpi_processes(communicator)
                    / seconds_done
              : 0.;
  }

  void Simulation::report_end(const nlohmann::json &summary)
  {
    /** Of what went through; user_guide.md, "Judge the result". */
    constexpr double largest_residual = 1e-3;
    if (std::abs(energy_residual()) > largest_residual)
      log.warning("the energy residual is "
                  + number_text(100. * energy_residual())
                  + " % of what went through, more than 0.1 %: energy came or "
                    "went that no account knows of. Compare with a run with "
                    "half the 'Share of critical time step'"
                  + (model->large_displacements()
                         ? "."
                         : "; blocks that turn or slide far need "
                           "'Displacements = large' in section 'Contact'."));
    log.message(
        "finished: " + std::to_string(record.state.step) + " steps in "
        + duration_text(record.wall_time) + ", "
        + (implicit_solver
               ? std::to_string(record.iterations) + " iterations"
               : number_text(summary["element updates per second"].get<double>()
                             / 1e6)
                     + " million element updates a second")
        + ", energy residual " + number_text(energy_residual())
        + " of what went through");
    if (solver->contacts())
      log.message(
          "contacts: "
          + number_text(summary["contact updates per second"].get<double>()
                        / 1e6)
          + " million updates a second, "
          + std::to_string(record.state.contacts.n_searches)
          + " searches that took "
          + number_text(100. * summary["contact search share"].get<double>())
          + " % of the time");
  }
} // namespace quoin
