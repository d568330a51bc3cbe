// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/problems/boundary_costs.h>
#include <quoin/problems/cost_estimate.h>
#include <quoin/tdbem/time_marching.h>

#include <algorithm>
#include <limits>

namespace quoin
{
  namespace
  {
    /** For measuring what steps cost [s]. */
    constexpr double measuring_time = 0.4;

    /** Integrals over elements, one a step, for measuring a point. */
    constexpr double most_integrals = 1e5;

    /** Of a vtu file for each element or point and moment [B]. */
    constexpr double bytes_of_element = 250., bytes_of_point = 150.;

    /** What all steps take, by some of them; spoils the history [s]. */
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
                 measuring_time, system.communicator,
                 period_of(*system.history));
    }

    /** What points in the domain take, by some of them [s]. */
    double seconds_of_points(const BoundarySystem &system,
                             const StepControl &control)
    {
      const double n_elements = system.geometry.boundary.n_elements();
      // All steps, or as many as are measured in a moment.
      const auto n = static_cast<unsigned int>(
          std::clamp(most_integrals / n_elements, 1., double(system.n_steps)));
      const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(
          n, Eigen::Index(system.geometry.boundary.n_unknowns()));
      const BoundaryRecord record{ system.dt, system.settings.decay, zero,
                                   zero };
      const double share = double(system.n_steps) / n;
      // Far from the boundary waves are late and a point costs less: some
      // points stand for all.
      const auto seconds = [&](const std::vector<Eigen::Vector2d> &points,
                               const std::vector<unsigned int> &steps)
      {
        constexpr std::size_t n_tried = 3;
        double sum                    = 0.;
        for (std::size_t i = 0; i < n_tried; ++i)
        {
          const Eigen::Vector2d &point
              = points[(2 * i + 1) * points.size() / (2 * n_tried)];
          // The best of some: a moment is easily disturbed.
          double best = std::numeric_limits<double>::infinity();
          for (unsigned int k = 0; k < 3; ++k)
          {
            const auto start = WallClock::now();
            system.domain_displacements(record, { point }, steps);
            best = std::min(best, seconds_since(start));
          }
          sum += best;
        }
        return dealii::Utilities::MPI::max(sum, system.communicator) * share
               / n_tried * double(points.size());
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
    std::string text = "time: about " + seconds_text(seconds_of_march(system))
                       + (system.settings.direct_history ? " or more" : "")
                       + " for " + std::to_string(system.n_steps) + " steps";
    if (system.needs_record())
      text += ", and " + seconds_text(seconds_of_points(system, control))
              + " for " + std::to_string(system.points_in_domain().size())
              + " points in the domain";
    run.log.message(text);
    run.log.message(
        "memory: " + bytes_text(resident_memory(system.communicator))
        + " by now"
        + (system.needs_record() ? ", and the record of the boundary" : ""));
    std::uint64_t moments = 0, rows = 0;
    for (std::uint64_t step = 0; step <= system.n_steps; ++step)
    {
      moments += control.fields_are_due(step) ? 1 : 0;
      rows += control.row_is_due(step) ? 1 : 0;
    }
    run.log.message(
        "disk: " + std::to_string(moments) + " moments of fields, "
        + bytes_text(
            moments
            * (bytes_of_element * double(system.geometry.boundary.n_elements())
               + bytes_of_point * double(system.sampled.points.size())))
        + "; " + std::to_string(rows) + " rows of tables, "
        + bytes_text(double(rows)
                     * bytes_of_row(system.histories->column_names().size())));
  }
} // namespace quoin
