// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/boundary_simulation.h>
#include <quoin/application/field_output.h>
#include <quoin/application/open_log.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/collective.h>
#include <quoin/output/json_file.h>

#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace quoin
{
  namespace
  {
    using Eigen::VectorXd;

    /** Steps between looks at the clock for a checkpoint. */
    constexpr std::uint64_t clock_interval = 16;

    std::vector<double> to_vector(const VectorXd &values)
    {
      return { values.data(), values.data() + values.size() };
    }

    /** Largest memory that this process has had [B]. */
    double peak_memory()
    {
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * double(usage.ru_maxrss);
    }
  } // namespace

  void BoundarySimulation::open_outputs()
  {
    history_table = std::make_unique<CsvTable>(output + "/histories.csv",
                                               histories->column_names());
    open_log(run_identity, output, options.resume, communicator, lock, log,
             record);
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            if (options.resume)
                              history_table->resume(record.histories_bytes);
                            else
                              history_table->start();
                            AtomicFile used(output + "/used_parameters.prm");
                            used.stream() << parameters.effective;
                            used.commit();
                            record.boundary_output.start();
                          });
  }

  void BoundarySimulation::write_static()
  {
    const StaticSolution &solution = *static_solution;
    const VectorXd &u              = solution.displacement;
    const BoundaryState state{ u, 0. * u, solution.traction,
                               (*hoop_stress)(u, solution.traction) };
    std::vector<double> row  = histories->row(settings.duration, state);
    const VectorXd at_points = static_interior_displacements(
        geometry.boundary, medium, solution, histories->interior_points());
    histories->set_interior(row, at_points, 0. * at_points);
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            history_table->add_row(row);
                            history_table->flush();
                          });
    write_boundary(settings.duration, state);
    if (!sampled_points.empty())
    {
      const VectorXd field = static_interior_displacements(
          geometry.boundary, medium, solution, sampled_points);
      write_sampled_field(settings.duration, field, 0. * field);
    }
  }

  void BoundarySimulation::write_row(const double time,
                                     const BoundaryState &state)
  {
    const std::vector<double> row = histories->row(time, state);
    if (!histories->interior_points().empty())
      record.rows.insert(record.rows.end(), row.begin(), row.end());
    else if (is_first_rank)
      history_table->add_row(row);
  }

  void BoundarySimulation::write_boundary(const double time,
                                          const BoundaryState &state)
  {
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                              record.boundary_output.write(
                                  time, boundary_fields(geometry, state));
                            history_table->flush();
                          });
  }

  void BoundarySimulation::checkpoint_if_due()
  {
    if (record.step % clock_interval != 0)
      return;
    all_or_none<RunError>(communicator, [&]() { history_table->check(); });
    if (parameters.checkpoint_interval == 0.)
      return;
    // The first rank's clock counts for all.
    const bool due = dealii::Utilities::MPI::broadcast(
        communicator,
        seconds_since(last_checkpoint) > parameters.checkpoint_interval);
    if (due)
      save_checkpoint();
  }

  void BoundarySimulation::save_checkpoint()
  {
    if (march)
    {
      record.history = history->save();
      record.u       = to_vector(march->u());
      record.p       = to_vector(march->p());
    }
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                            {
                              history_table->sync();
                              record.histories_bytes = history_table->size();
                            }
                          });
    CheckpointInfo info;
    info.step       = record.step;
    info.time       = record.step * dt;
    info.version    = QUOIN_VERSION;
    info.parameters = run_identity;
    quoin::save_checkpoint(output, communicator, info, record);
    last_checkpoint = WallClock::now();
  }

  void BoundarySimulation::write_summary()
  {
    const VectorXd lengths = geometry.boundary.lengths();
    nlohmann::json summary
        = { { "title", parameters.title },
            { "version", QUOIN_VERSION },
            { "finished", record.finished },
            { "ranks", dealii::Utilities::MPI::n_mpi_processes(communicator) },
            { "boundaries", settings.boundaries.size() },
            { "boundary elements", lengths.size() },
            { "boundary length [m]", lengths.sum() },
            { "shortest element [m]", lengths.minCoeff() },
            { "longest element [m]", lengths.maxCoeff() },
            { "P wave speed [m/s]", medium.c1 },
            { "S wave speed [m/s]", medium.c2 },
            { "points in the domain",
              sampled_points.size() + histories->interior_points().size() },
            { "wall time [s]", record.wall_time },
            { "peak memory [B]",
              dealii::Utilities::MPI::max(peak_memory(), communicator) } };
    if (!settings.is_static)
    {
      summary["time [s]"]             = record.step * dt;
      summary["steps"]                = record.step;
      summary["time step [s]"]        = dt;
      summary["step ratio, smallest"] = medium.c1 * dt / lengths.maxCoeff();
      summary["step ratio, largest"]  = medium.c1 * dt / lengths.minCoeff();
      summary["wall time per step [s]"]
          = steps_done > 0 ? seconds_done / double(steps_done) : 0.;
    }
    if (passivity)
      summary["passivity"] = { { "smallest eigenvalue [rho c2]",
                                 passivity->smallest_eigenvalue },
                               { "frequency [Hz]", passivity->frequency },
                               { "highest frequency [Hz]", passivity->nyquist },
                               { "frequencies", passivity->n_scanned } };
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                              write_json(output + "/summary.json", summary);
                          });
    if (!record.finished)
      return;
    log.message("finished: "
                + (settings.is_static ? std::string("static solution")
                                      : std::to_string(record.step) + " steps")
                + " in " + duration_text(record.wall_time) + ", "
                + number_text(1e-6 * peak_memory()) + " MB");
  }
} // namespace quoin
