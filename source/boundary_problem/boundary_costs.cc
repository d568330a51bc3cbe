// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/boundary_problem/boundary_costs.h>
#include <quoin/problems/planned_output.h>
#include <quoin/results/measurements.h>
#include <quoin/tdbem/time_marching.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Time for measuring the steps [s]. */
    constexpr double measuring_time = 0.5;

    /** Number of integrals over elements, one a step, for measuring a point. */
    constexpr double most_integrals = 1e5;

    /** Bytes in vtu files of each element or point at an output time. */
    constexpr double bytes_of_element = 250., bytes_of_point = 150.;

    /** Time of all steps, estimated from some; overwrites the history [s]. */
    double seconds_of_march(BoundarySystem &system)
    {
      TimeMarching trial(*system.kernel, *system.history,
                         system.given->traction_is_given());
      std::uint64_t step = 0;
      return double(system.n_steps)
             * seconds_per_call(
                 [&]()
                 {
                   const double start
                       = double(step++ % system.n_steps) * system.dt,
                       end = start + system.dt;
                   trial.step(system.scattered_values(
                       start, end, system.waves->displacements(end),
                       system.waves->tractions(start, end)));
                 },
                 measuring_time, system.communicator, system.history->period());
    }

    /** Time of the points in the domain, estimated from some [s]. */
    double seconds_of_points(const BoundarySystem &system,
                             const StepControl &control)
    {
      const double n_elements = system.geometry.boundary.n_elements();
      // All steps, or as many as are measured quickly.
      const auto n = static_cast<unsigned int>(
          std::clamp(most_integrals / n_elements, 1., double(system.n_steps)));
      const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(
          n, Eigen::Index(system.geometry.boundary.n_unknowns()));
      const BoundaryRecord record{ system.dt, system.settings.decay, zero,
                                   zero };
      const double share = double(system.n_steps) / n;
      // Points far from the boundary, where waves arrive late, cost less: a
      // sample of points is taken.
      const auto seconds = [&](const std::vector<dealii::Point<2>> &points,
                               const std::vector<unsigned int> &steps)
      {
        constexpr std::size_t n_tried = 3;
        const auto try_some           = [&]()
        {
          for (std::size_t i = 0; i < n_tried; ++i)
            system.domain_displacements(
                record, { points[(2 * i + 1) * points.size() / (2 * n_tried)] },
                steps);
        };
        return seconds_per_call(try_some, 0.1 * measuring_time,
                                system.communicator)
               * share / n_tried * double(points.size());
      };
      const auto due = [&](const auto &is_due)
      {
        std::vector<unsigned int> steps(1, n);
        for (unsigned int step = 1; step < n; ++step)
          if (is_due(step)) // the one before is for the velocity
            steps.insert(steps.end(), { step - 1, step });
        return steps;
      };
      double result = 0.;
      if (!system.histories->interior_points().empty())
        result += seconds(system.histories->interior_points(),
                          due(control.row_is_due));
      if (!system.sampled.points.empty())
        result += seconds(system.sampled.points, due(control.fields_are_due));
      return result
             / double(
                 dealii::Utilities::MPI::n_mpi_processes(system.communicator));
    }
  } // namespace

  void report_boundary_costs(BoundarySystem &system, const StepControl &control,
                             const RunContext &run)
  {
    std::string of_points;
    if (system.needs_record())
      of_points = text_of(
          ", and ", seconds_text(seconds_of_points(system, control)), " for ",
          system.points_in_domain().size(), " points in the domain");
    run.log.message("time: about ", seconds_text(seconds_of_march(system)),
                    system.settings.direct_history ? " or more" : "", " for ",
                    system.n_steps, " steps", of_points);
    PlannedOutput planned;
    for (std::uint64_t step = 0; step <= system.n_steps; ++step)
    {
      planned.fields += control.fields_are_due(step) ? 1 : 0;
      planned.rows += control.row_is_due(step) ? 1 : 0;
    }
    report_memory_and_disk(
        run, system.needs_record() ? ", and the record of the boundary" : "",
        planned,
        bytes_of_element * double(system.geometry.boundary.n_elements())
            + bytes_of_point * double(system.sampled.points.size()),
        system.histories->column_names().size());
  }
} // namespace quoin
