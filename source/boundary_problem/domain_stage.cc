// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/boundary_problem/boundary_stage.h>

#include <algorithm>
#include <array>
#include <utility>

namespace quoin
{
  using Eigen::VectorXd;

  namespace
  {
    /** Points of the sampled field that are computed at a time. */
    constexpr std::size_t batch_size = 256;

    std::vector<dealii::Tensor<1, 2>> vectors(const VectorXd &values)
    {
      std::vector<dealii::Tensor<1, 2>> result;
      for (Eigen::Index k = 0; k < values.size() / 2; ++k)
        result.push_back(vector_at(values, k));
      return result;
    }

    class DomainStage : public Stage
    {
    public:
      explicit DomainStage(BoundaryContext &context)
        : context(context), system(context.system),
          output(context.run.output, MPI_COMM_SELF,
                 system.parameters.field_format)
      {
      }

      /** Takes the record of the boundary out of the state. */
      void begin() override;
      /** No checkpoint is written: the stage begins anew. */
      void resume() override
      {
      }
      bool has_ended() const override
      {
        return rows.empty() && n_done == system.sampled.points.size();
      }
      /** Computes histories first, then some points of the field in each step;
          the last step writes it. */
      Checkpoint take_step() override
      {
        rows.empty() ? sample() : write_histories();
        return Checkpoint::kept;
      }
      ProgressFigures figures() const override;
      void end() override
      {
      }

    private:
      void write_histories();
      void sample();

      BoundaryContext &context;
      const BoundarySystem &system;
      SampledFieldOutput output;

      BoundaryRecord record;
      /** Rows of histories.csv still without values in the domain; empty: none,
          or written. */
      std::vector<double> rows;
      /** Steps of the fields and the steps before them. */
      std::vector<unsigned int> steps;
      std::size_t n_done = 0; /**< points of the field */
      /** Displacement of the points in all steps [m]. */
      Eigen::MatrixXd displacement;
    };

    void DomainStage::begin()
    {
      const auto n     = Eigen::Index(system.n_steps);
      const auto size  = Eigen::Index(system.geometry.boundary.n_unknowns());
      const auto taken = [&](std::vector<double> &all) -> Eigen::MatrixXd
      { return Eigen::MatrixXd::Map(std::exchange(all, {}).data(), n, size); };
      record.time_step    = system.dt;
      record.decay        = system.settings.decay;
      record.displacement = taken(context.state.all_u);
      record.traction     = taken(context.state.all_p);
      rows                = std::exchange(context.state.rows, {});
      for (std::uint64_t step = 0; step <= system.n_steps; ++step)
        if (context.control.fields_are_due(step))
          steps.insert(steps.end(),
                       { static_cast<unsigned int>(step == 0 ? 0 : step - 1),
                         static_cast<unsigned int>(step) });
      displacement.resize(2 * Eigen::Index(system.sampled.points.size()),
                          Eigen::Index(steps.size()));
    }

    ProgressFigures DomainStage::figures() const
    {
      ProgressFigures figures;
      figures.stage  = "field in the domain";
      figures.step   = context.state.step;
      figures.time   = double(figures.step) * system.dt;
      const double n = system.sampled.points.size();
      if (n > 0.)
        figures.fraction = double(n_done) / n;
      return figures;
    }

    void DomainStage::write_histories()
    {
      // Each step and, for the velocity, the one before it.
      std::vector<unsigned int> wanted;
      std::vector<std::array<std::size_t, 2>> columns;
      for (std::uint64_t step = 0; step <= system.n_steps; ++step)
        if (context.control.row_is_due(step))
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
      Eigen::MatrixXd u;
      context.measured("domain",
                       [&]()
                       {
                         u = system.domain_displacements(
                             record, histories.interior_points(), wanted);
                       });
      const std::size_t n_columns = histories.column_names().size();
      const auto write_rows       = [&]()
      {
        RootTable &table = context.history_table;
        table.start();
        for (std::size_t r = 0; r < columns.size(); ++r)
        {
          const auto begin = rows.begin() + r * n_columns;
          std::vector<double> row(begin, begin + n_columns);
          const VectorXd now = u.col(columns[r][0]);
          histories.set_interior(row, now,
                                 (now - u.col(columns[r][1])) / system.dt);
          table.add_row(row);
        }
        table.flush();
      };
      context.measured("output",
                       [&]() { context.run.on_first_rank(write_rows); });
      rows = {};
    }

    void DomainStage::sample()
    {
      const auto &points    = system.sampled.points;
      const std::size_t end = std::min(n_done + batch_size, points.size());
      context.measured(
          "domain",
          [&]()
          {
            displacement.middleRows(2 * n_done, 2 * (end - n_done))
                = system.domain_displacements(
                    record, { points.begin() + n_done, points.begin() + end },
                    steps);
          });
      n_done = end;
      if (n_done < points.size())
        return;
      context.measured(
          "output",
          [&]()
          {
            for (std::size_t k = 1; k < steps.size(); k += 2)
              write_field(
                  context, output, steps[k] * system.dt, displacement.col(k),
                  (displacement.col(k) - displacement.col(k - 1)) / system.dt);
          });
    }
  } // namespace

  void write_field(const BoundaryContext &context, SampledFieldOutput &output,
                   const double time, const VectorXd &displacement,
                   const VectorXd &velocity)
  {
    context.run.on_first_rank(
        [&]()
        {
          const DomainPoints &sampled = context.system.sampled;
          if (output.n_written() == 0)
            output.start();
          SampledFields fields;
          fields.position     = sampled.points;
          fields.triangles    = sampled.triangles;
          fields.displacement = vectors(displacement);
          fields.velocity     = vectors(velocity);
          output.write(time, fields);
        });
  }

  std::unique_ptr<Stage> make_domain_stage(BoundaryContext &context)
  {
    return std::make_unique<DomainStage>(context);
  }
} // namespace quoin
