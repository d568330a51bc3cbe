// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/wall_clock.h>
#include <quoin/boundary_problem/boundary_stage.h>
#include <quoin/output/checkpoint_clock.h>
#include <quoin/results/field_output.h>
#include <quoin/tdbem/plain_vector.h>

namespace quoin
{
  using Eigen::VectorXd;

  namespace
  {
    /** Whether a step is the last one or one of @p times. */
    std::function<bool(std::uint64_t)> due_steps(const BoundarySystem &system,
                                                 const TimeControl &times)
    {
      return
          [=, dt = system.dt, last = system.n_steps](const std::uint64_t step)
      { return step == last || times.is_due(double(step) * dt, dt); };
    }
  } // namespace

  BoundaryContext::BoundaryContext(const Parameters &parameters,
                                   const RunContext &run)
    : run(run), settings(parameters.boundary),
      system(parameters, run.communicator),
      control{ due_steps(system, parameters.row_times()),
               due_steps(system, parameters.field_times()) },
      history_table(
          run.tables.add("histories.csv", system.histories->column_names())),
      boundary_output(run.output, MPI_COMM_SELF, parameters.field_format)
  {
  }

  void BoundaryContext::write_boundary(const double time,
                                       const BoundaryState &fields)
  {
    run.on_first_rank(
        [&]()
        {
          boundary_output.write(time, boundary_fields(system.geometry, fields));
          history_table.flush();
        });
  }

  namespace
  {
    class MarchingStage : public Stage
    {
    public:
      explicit MarchingStage(BoundaryContext &context)
        : context(context), system(context.system), state(context.state)
      {
      }

      void begin() override;
      void resume() override;
      bool has_ended() const override
      {
        return state.step == system.n_steps;
      }
      Checkpoint take_step() override;
      ProgressFigures figures() const override;
      void end() override;

    private:
      void prepare();
      void march_on();
      /** The row and the fields of the last step, if they are due. */
      void write_step(const VectorXd &u_incident, const VectorXd &p_incident);
      void write_row(double time, const BoundaryState &fields);

      BoundaryContext &context;
      BoundarySystem &system;
      BoundaryContext::State &state;
      VectorXd last_displacement; /**< total [m] */
    };

    void MarchingStage::prepare()
    {
      context.seconds
          += context.measured("matrices",
                              [&]()
                              {
                                context.marching
                                    = std::make_unique<TimeMarching>(
                                        *system.kernel, *system.history,
                                        system.given->traction_is_given());
                              });
    }

    void MarchingStage::begin()
    {
      prepare();
      const std::size_t size = system.geometry.boundary.n_unknowns();
      last_displacement      = VectorXd::Zero(Eigen::Index(size));
      if (system.needs_record())
      {
        state.all_u.assign(system.n_steps * size, 0.);
        state.all_p.assign(system.n_steps * size, 0.);
      }
      const BoundaryState rest{ last_displacement, last_displacement,
                                last_displacement,
                                VectorXd::Zero(Eigen::Index(size / 2)) };
      if (context.control.row_is_due(0))
        write_row(0., rest);
      if (context.control.fields_are_due(0))
        context.write_boundary(0., rest);
    }

    void MarchingStage::resume()
    {
      if (state.step == 0)
        return begin();
      prepare();
      system.history->restore(state.history);
      context.marching->restore(to_eigen(state.u), to_eigen(state.p));
      last_displacement
          = context.marching->u()
            + system.waves->displacements(double(state.step) * system.dt);
    }

    Stage::Checkpoint MarchingStage::take_step()
    {
      const auto start = WallClock::now();
      march_on();
      ++context.n_done;
      context.march_seconds += seconds_since(start);
      if (state.step % CheckpointClock::steps_between_looks != 0)
        return Checkpoint::no;
      context.run.tables.check();
      return Checkpoint::possible;
    }

    void MarchingStage::march_on()
    {
      TimeMarching &marching    = *context.marching;
      const std::uint64_t step  = state.step + 1;
      const double begin        = double(state.step) * system.dt,
                   end          = double(step) * system.dt;
      const VectorXd u_incident = system.waves->displacements(end);
      const VectorXd p_incident = system.waves->tractions(begin, end);
      const VectorXd given
          = system.scattered_values(begin, end, u_incident, p_incident);
      context.measured("history", [&]() { marching.predict(); });
      context.measured("solve", [&]() { marching.begin_step(given); });
      context.measured("history", [&]() { marching.finish_step(); });
      if (!marching.u().allFinite() || !marching.p().allFinite())
        throw RunError(text_of(
            "boundary elements: the solution is no longer finite at time ", end,
            " s. If it grew before, the formulation is not stable with this "
            "time step: take 'Formulation = Galerkin' and a larger 'Step "
            "ratio'."));
      if (system.needs_record())
        for (Eigen::Index k = 0; k < marching.u().size(); ++k)
        {
          state.all_u[k * system.n_steps + state.step] = marching.u()[k];
          state.all_p[k * system.n_steps + state.step] = marching.p()[k];
        }
      state.step = step;
      context.measured("output", [&]() { write_step(u_incident, p_incident); });
    }

    void MarchingStage::write_step(const VectorXd &u_incident,
                                   const VectorXd &p_incident)
    {
      const double end = double(state.step) * system.dt;
      const bool row   = context.control.row_is_due(state.step),
                 all   = context.control.fields_are_due(state.step);
      BoundaryState fields;
      fields.displacement = context.marching->u() + u_incident;
      if (row || all)
      {
        fields.velocity = (fields.displacement - last_displacement) / system.dt;
        fields.traction = context.marching->p() + p_incident;
        // Displacements are those at the end of the step, and so are prescribed
        // tractions.
        const auto &of_traction = system.given->traction_is_given();
        const VectorXd p_given  = system.given->at(end);
        VectorXd p_end          = fields.traction;
        for (Eigen::Index k = 0; k < p_end.size(); ++k)
          if (of_traction[k])
            p_end[k] = p_given[k];
        fields.hoop_stress = (*system.hoop_stress)(fields.displacement, p_end);
      }
      if (row)
        write_row(end, fields);
      if (all)
        context.write_boundary(end, fields);
      last_displacement = fields.displacement;
    }

    void MarchingStage::write_row(const double time,
                                  const BoundaryState &fields)
    {
      const std::vector<double> row = system.histories->row(time, fields);
      if (!system.histories->interior_points().empty())
        state.rows.insert(state.rows.end(), row.begin(), row.end());
      else
        context.history_table.add_row(row);
    }

    ProgressFigures MarchingStage::figures() const
    {
      ProgressFigures figures;
      figures.stage    = "boundary elements";
      figures.time     = double(state.step) * system.dt;
      figures.step     = state.step;
      figures.fraction = double(state.step) / double(system.n_steps);
      return figures;
    }

    void MarchingStage::end()
    {
      // There is nothing to resume.
      context.marching.reset();
      state.history = {};
    }

    class StaticStage : public Stage
    {
    public:
      explicit StaticStage(BoundaryContext &context)
        : context(context), system(context.system)
      {
      }

      void begin() override
      {
      }
      void resume() override
      {
      }
      bool has_ended() const override
      {
        return is_written;
      }
      Checkpoint take_step() override;
      ProgressFigures figures() const override
      {
        ProgressFigures figures;
        figures.stage = "boundary elements";
        return figures;
      }
      void end() override
      {
      }

    private:
      void write();
      VectorXd displacements(const std::vector<dealii::Point<2>> &points) const
      {
        return static_interior_displacements(
            system.geometry.boundary, system.medium, *context.solution, points);
      }

      BoundaryContext &context;
      BoundarySystem &system;
      bool is_written = false;
    };

    void StaticStage::write()
    {
      const double time = context.settings.duration;
      const VectorXd &u = context.solution->displacement;
      const VectorXd &p = context.solution->traction;
      const BoundaryState fields{ u, 0. * u, p, (*system.hoop_stress)(u, p) };
      const BoundaryHistories &histories = *system.histories;
      std::vector<double> row            = histories.row(time, fields);
      const VectorXd at_points = displacements(histories.interior_points());
      histories.set_interior(row, at_points, 0. * at_points);
      context.history_table.add_row(row);
      context.write_boundary(time, fields);
      if (!system.sampled.points.empty())
      {
        SampledFieldOutput output(context.run.output, MPI_COMM_SELF,
                                  system.parameters.field_format);
        const VectorXd field = displacements(system.sampled.points);
        write_field(context, output, time, field, 0. * field);
      }
    }

    Stage::Checkpoint StaticStage::take_step()
    {
      context.measured("output", [&]() { write(); });
      is_written = true;
      context.run.tables.check();
      return Checkpoint::no;
    }
  } // namespace

  std::unique_ptr<Stage> make_marching_stage(BoundaryContext &context)
  {
    return std::make_unique<MarchingStage>(context);
  }

  std::unique_ptr<Stage> make_static_stage(BoundaryContext &context)
  {
    return std::make_unique<StaticStage>(context);
  }
} // namespace quoin
