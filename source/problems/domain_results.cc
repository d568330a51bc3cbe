// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/domain_results.h>
#include <quoin/results/collective.h>

#include <algorithm>

namespace quoin
{
  using Eigen::VectorXd;

  namespace
  {
    /** Points of the sampled field that are computed at a time. */
    constexpr std::size_t batch_size = 256;

    std::vector<std::array<double, 2>> pairs(const VectorXd &values)
    {
      std::vector<std::array<double, 2>> result(values.size() / 2);
      for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = { { values[2 * k], values[2 * k + 1] } };
      return result;
    }
  } // namespace

  DomainResults::DomainResults(const BoundarySystem &system,
                               const RunContext &run,
                               const StepControl &control, RootTable &table)
    : system(system), run(run), control(control), table(table),
      output(run.output, MPI_COMM_SELF)
  {
  }

  void DomainResults::begin(const std::vector<double> &u,
                            const std::vector<double> &p,
                            std::vector<double> &&rows_)
  {
    const auto n        = Eigen::Index(system.n_steps);
    const auto size     = Eigen::Index(system.geometry.boundary.n_unknowns());
    record.time_step    = system.dt;
    record.decay        = system.settings.decay;
    record.displacement = Eigen::MatrixXd::Map(u.data(), n, size);
    record.traction     = Eigen::MatrixXd::Map(p.data(), n, size);
    rows                = std::move(rows_);
    for (std::uint64_t step = 0; step <= system.n_steps; ++step)
      if (control.fields_are_due(step))
        steps.insert(steps.end(),
                     { static_cast<unsigned int>(step == 0 ? 0 : step - 1),
                       static_cast<unsigned int>(step) });
    displacement.resize(2 * Eigen::Index(system.sampled.points.size()),
                        Eigen::Index(steps.size()));
  }

  bool DomainResults::is_over() const
  {
    return rows.empty() && n_done == system.sampled.points.size();
  }

  double DomainResults::fraction() const
  {
    const double n = system.sampled.points.size();
    return n > 0. ? double(n_done) / n : -1.;
  }

  void DomainResults::take_step()
  {
    if (!rows.empty())
      write_histories();
    else
      sample();
  }

  void DomainResults::write_histories()
  {
    // A step and, for the velocity, the one before it.
    std::vector<unsigned int> wanted;
    std::vector<std::array<std::size_t, 2>> columns;
    for (std::uint64_t step = 0; step <= system.n_steps; ++step)
      if (control.row_is_due(step))
      {
        std::array<std::size_t, 2> column{};
        for (const unsigned int k : { 1U, 0U })
        {
          const auto next = static_cast<unsigned int>(
              step - std::min<std::uint64_t>(k, step));
          if (wanted.empty() || wanted.back() != next)
            wanted.push_back(next);
          column[k] = wanted.size() - 1;
        }
        columns.push_back(column);
      }
    const BoundaryHistories &histories = *system.histories;
    const Eigen::MatrixXd u            = system.domain_displacements(
                   record, histories.interior_points(), wanted);
    const std::size_t n_columns = histories.column_names().size();
    all_or_none<RunError>(run.communicator,
                          [&]()
                          {
                            table.start();
                            for (std::size_t r = 0; r < columns.size(); ++r)
                            {
                              const auto begin = rows.begin() + r * n_columns;
                              std::vector<double> row(begin, begin + n_columns);
                              const VectorXd now = u.col(columns[r][0]);
                              histories.set_interior(
                                  row, now,
                                  (now - u.col(columns[r][1])) / system.dt);
                              table.add_row(row);
                            }
                            table.flush();
                          });
    rows = {};
  }

  void DomainResults::sample()
  {
    const auto &points    = system.sampled.points;
    const std::size_t end = std::min(n_done + batch_size, points.size());
    displacement.middleRows(2 * n_done, 2 * (end - n_done))
        = system.domain_displacements(
            record, { points.begin() + n_done, points.begin() + end }, steps);
    n_done = end;
    for (std::size_t k = 1; n_done == points.size() && k < steps.size(); k += 2)
      write_field(steps[k] * system.dt, displacement.col(k),
                  (displacement.col(k) - displacement.col(k - 1)) / system.dt);
  }

  void DomainResults::write_static(const double time,
                                   const StaticSolution &solution)
  {
    if (system.sampled.points.empty())
      return;
    const VectorXd field
        = static_interior_displacements(system.geometry.boundary, system.medium,
                                        solution, system.sampled.points);
    write_field(time, field, 0. * field);
  }

  void DomainResults::write_field(const double time,
                                  const VectorXd &displacement,
                                  const VectorXd &velocity)
  {
    all_or_none<RunError>(run.communicator,
                          [&]()
                          {
                            if (!run.is_first_rank())
                              return;
                            if (output.n_written() == 0)
                              output.start();
                            SampledFields fields = system.sampled.fields;
                            fields.displacement  = pairs(displacement);
                            fields.velocity      = pairs(velocity);
                            output.write(time, fields);
                          });
  }
} // namespace quoin
