// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/boundary_simulation.h>
#include <quoin/results/field_output.h>
#include <quoin/problems/open_log.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/results/atomic_file.h>
#include <quoin/results/checkpoint.h>
#include <quoin/results/collective.h>
#include <quoin/results/json_file.h>
#include <quoin/tdbem/plain_vector.h>

#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace quoin
{
  namespace
  {
    using Eigen::VectorXd;

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
    if (is_first_rank)
      record.history_table.make(output + "/histories.csv",
                                histories->column_names());
    open_log(run_identity, output, options.resume, communicator, lock, log,
             record);
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            if (options.resume)
                              record.history_table.resume();
                            else
                              record.history_table.start();
                            write_text(output + "/used_parameters.prm",
                                       parameters.effective);
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
                            record.history_table.add_row(row);
                            record.history_table.flush();
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
    else
      record.history_table.add_row(row);
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
                            record.history_table.flush();
                          });
  }

  void BoundarySimulation::checkpoint_if_due()
  {
    if (record.step % CheckpointClock::steps_between_looks != 0)
      return;
    all_or_none<RunError>(communicator,
                          [&]() { record.history_table.check(); });
    if (checkpoint_clock.is_due())
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
    all_or_none<RunError>(communicator, [&]() { record.history_table.sync(); });
    quoin::save_checkpoint(
        output, communicator,
        { record.step, record.step * dt, QUOIN_VERSION, run_identity }, record);
    checkpoint_clock.restart();
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
