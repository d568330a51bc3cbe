// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What BoundarySimulation says with --check beyond sizes and the time step,
// and what it warns of in any run.

#include <quoin/problems/boundary_simulation.h>
#include <quoin/problems/cost_estimate.h>
#include <quoin/problems/shaking.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>

#include <algorithm>
#include <limits>

namespace quoin
{
  namespace
  {
    using Eigen::VectorXd;

    /** For measuring what steps cost [s]. */
    constexpr double measuring_time = 0.4;

    /** Integrals over elements, one a step, for measuring a point. */
    constexpr double most_integrals = 1e5;

    /** Of a vtu file for each element or point and moment [B]. */
    constexpr double bytes_of_element = 250., bytes_of_point = 150.;
  } // namespace

  void BoundarySimulation::advise()
  {
    for (const std::string &text : element_advice(
             fastest_boundary_value(settings, geometry, settings.duration),
             medium.c2, geometry.boundary.lengths().maxCoeff()))
      log.warning(text);
  }

  double BoundarySimulation::seconds_of_march()
  {
    TimeMarching trial(*kernel, *history, given->traction_is_given());
    std::uint64_t step = 0;
    return double(n_steps)
           * seconds_per_call(
               [&]()
               {
                 const double start = double(step++ % n_steps) * dt,
                              end   = start + dt;
                 trial.step(scattered_values(start, end,
                                             waves->displacements(end),
                                             waves->tractions(start, end)));
               },
               measuring_time, communicator, period_of(*history));
  }

  double BoundarySimulation::seconds_of_points() const
  {
    const double n_elements = geometry.boundary.n_elements();
    // All steps, or as many as are measured in a moment.
    const auto n = static_cast<unsigned int>(
        std::clamp(most_integrals / n_elements, 1., double(n_steps)));
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(
        n, Eigen::Index(geometry.boundary.n_unknowns()));
    const BoundaryRecord record{ dt, settings.decay, zero, zero };
    const double share = double(n_steps) / n;
    // Far from the boundary waves are late and a point costs less: some points
    // stand for all.
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
          domain_displacements(record, { point }, steps);
          best = std::min(best, seconds_since(start));
        }
        sum += best;
      }
      return dealii::Utilities::MPI::max(sum, communicator) * share / n_tried
             * double(points.size());
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
    if (!histories->interior_points().empty())
      result += seconds(
          histories->interior_points(),
          due([this](const unsigned int step) { return row_is_due(step); }));
    if (!sampled_points.empty())
      result += seconds(sampled_points, due([this](const unsigned int step)
                                            { return fields_are_due(step); }));
    return result
           / double(dealii::Utilities::MPI::n_mpi_processes(communicator));
  }

  void BoundarySimulation::report_costs()
  {
    // Nobody would read it; and statics is solved by now.
    if (options.quiet || settings.is_static)
      return;
    std::string text = "time: about " + seconds_text(seconds_of_march())
                       + (settings.direct_history ? " or more" : "") + " for "
                       + std::to_string(n_steps) + " steps";
    if (needs_record())
      text += ", and " + seconds_text(seconds_of_points()) + " for "
              + std::to_string(points_in_domain().size())
              + " points in the domain";
    log.message(text);
    log.message("memory: " + bytes_text(resident_memory(communicator))
                + " by now"
                + (needs_record() ? ", and the record of the boundary" : ""));
    std::uint64_t moments = 0, rows = 0;
    for (std::uint64_t step = 0; step <= n_steps; ++step)
    {
      moments += fields_are_due(step) ? 1 : 0;
      rows += row_is_due(step) ? 1 : 0;
    }
    log.message("disk: " + std::to_string(moments) + " moments of fields, "
                + bytes_text(
                    moments
                    * (bytes_of_element * double(geometry.boundary.n_elements())
                       + bytes_of_point * double(sampled_points.size())))
                + "; " + std::to_string(rows) + " rows of tables, "
                + bytes_text(double(rows)
                             * bytes_of_row(histories->column_names().size())));
  }
} // namespace quoin
