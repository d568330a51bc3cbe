// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/time_control.h>
#include <quoin/base/wall_clock.h>
#include <quoin/problems/boundary_costs.h>
#include <quoin/problems/boundary_problem.h>
#include <quoin/problems/boundary_report.h>
#include <quoin/problems/model_summary.h>
#include <quoin/problems/shaking.h>
#include <quoin/results/checkpoint_clock.h>
#include <quoin/results/collective.h>
#include <quoin/results/field_output.h>
#include <quoin/tdbem/plain_vector.h>

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>

namespace quoin
{
  using Eigen::VectorXd;

  namespace
  {
    /** Largest memory that this process has had [B]. */
    double peak_memory()
    {
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * double(usage.ru_maxrss);
    }

    /** Whether a step is the last one or @p interval [s] has passed; if that is
        negative, the last one alone. */
    std::function<bool(std::uint64_t)> due_steps(const BoundarySystem &system,
                                                 const double interval)
    {
      return [control = TimeControl(interval), dt = system.dt,
              last = system.n_steps](const std::uint64_t step)
      { return step == last || control.is_due(double(step) * dt, dt); };
    }
  } // namespace

  BoundaryProblem::BoundaryProblem(const Parameters &parameters,
                                   const RunContext &run)
    : parameters(parameters), settings(parameters.boundary), run(run),
      system(parameters, run.communicator),
      control{ due_steps(system, parameters.history_interval),
               due_steps(system, parameters.field_interval > 0.
                                     ? parameters.field_interval
                                     : -1.) },
      history_table(
          run.tables.add("histories.csv", system.histories->column_names())),
      boundary_output(run.output, MPI_COMM_SELF),
      domain(system, run, control, history_table)
  {
  }

  std::string BoundaryProblem::fingerprint() const
  {
    return system.fingerprint;
  }

  unsigned int BoundaryProblem::n_stages() const
  {
    return !settings.is_static && system.needs_record() ? 2 : 1;
  }

  // -- before the first step ------------------------------------------------

  void BoundaryProblem::report()
  {
    run.log.message(parameters.title.empty() ? parameters.file
                                             : parameters.title);
    for (const std::string &line : boundary_lengths(settings, system.geometry))
      run.log.message(line);
    for (const MaterialParameters &material : parameters.model.materials)
      if (material.name == settings.material)
        run.log.message("material " + material.name + ": "
                        + material_text(material, parameters.model.plane));
    if (run.options.check)
      for (const std::string &line :
           boundary_lines(settings, system.geometry, settings.duration))
        run.log.message(line);
    if (!system.sampled.points.empty())
      run.log.message("sampled field: "
                      + std::to_string(system.sampled.points.size())
                      + " points");
    if (settings.is_static)
      return naming(parameters.file, [&]() { solve_static(); });
    report_steps();
    system.make_operators(run.log);
    // Nobody would read it.
    if (run.options.check && !run.options.quiet)
      report_boundary_costs(system, control, run);
  }

  void BoundaryProblem::report_steps()
  {
    const Boundary &boundary = system.geometry.boundary;
    for (const std::string &text :
         element_advice(fastest_boundary_value(settings, system.geometry,
                                               settings.duration),
                        system.medium.c2, boundary.lengths().maxCoeff()))
      run.log.warning(text);
    run.log.message("time step " + number_text(system.dt) + " s, "
                    + step_ratio_text(boundary, system.medium, system.dt) + ", "
                    + std::to_string(system.n_steps) + " steps");
    for (const std::string &text : system.waves->reports())
      run.log.message(text);
    if (system.needs_record())
      run.log.message(
          "record of the boundary: "
          + number_text(2e-6 * double(sizeof(double)) * double(system.n_steps)
                        * double(boundary.n_unknowns()))
          + " MB");
  }

  void BoundaryProblem::solve_static()
  {
    const auto start = WallClock::now();
    solution         = system.solve_static();
    solution_seconds = seconds_since(start);
  }

  void BoundaryProblem::open_outputs()
  {
    all_or_none<RunError>(run.communicator,
                          [&]()
                          {
                            if (run.is_first_rank())
                              boundary_output.start();
                          });
  }

  // -- stages ---------------------------------------------------------------

  void BoundaryProblem::resume(const unsigned int stage, const bool has_begun)
  {
    if (has_begun && stage == 0 && !settings.is_static)
      make_march();
  }

  void BoundaryProblem::begin_stage(const unsigned int stage)
  {
    in_domain = stage == 1;
    if (in_domain)
      domain.begin(std::exchange(state.all_u, {}),
                   std::exchange(state.all_p, {}),
                   std::exchange(state.rows, {}));
    else if (!settings.is_static)
      make_march();
  }

  bool BoundaryProblem::stage_is_over() const
  {
    if (in_domain)
      return domain.is_over();
    return settings.is_static ? has_solution : state.step == system.n_steps;
  }

  Problem::Checkpoint BoundaryProblem::take_step()
  {
    if (in_domain)
      domain.take_step();
    else if (settings.is_static)
      write_static();
    else
      march_on();
    // The domain begins anew if it is interrupted.
    if (in_domain || state.step % CheckpointClock::steps_between_looks != 0)
      return Checkpoint::no;
    run.tables.check();
    return Checkpoint::possible;
  }

  void BoundaryProblem::end_stage()
  {
    // There is nothing to resume.
    march.reset();
    state.history = {};
  }

  ProgressFigures BoundaryProblem::progress_figures() const
  {
    ProgressFigures figures;
    figures.stage = in_domain ? "field in the domain" : "boundary elements";
    figures.time  = double(state.step) * system.dt;
    figures.step  = state.step;
    if (in_domain)
      figures.fraction = domain.fraction();
    else if (!settings.is_static)
      figures.fraction = double(state.step) / double(system.n_steps);
    return figures;
  }

  // -- statics --------------------------------------------------------------

  void BoundaryProblem::write_static()
  {
    const VectorXd &u = solution->displacement;
    const BoundaryState fields{ u, 0. * u, solution->traction,
                                (*system.hoop_stress)(u, solution->traction) };
    const BoundaryHistories &histories = *system.histories;
    std::vector<double> row = histories.row(settings.duration, fields);
    const VectorXd at_points
        = static_interior_displacements(system.geometry.boundary, system.medium,
                                        *solution, histories.interior_points());
    histories.set_interior(row, at_points, 0. * at_points);
    all_or_none<RunError>(run.communicator,
                          [&]()
                          {
                            history_table.add_row(row);
                            history_table.flush();
                          });
    write_boundary(settings.duration, fields);
    domain.write_static(settings.duration, *solution);
    has_solution = true;
  }

  // -- time marching --------------------------------------------------------

  void BoundaryProblem::make_march()
  {
    const std::size_t size = system.geometry.boundary.n_unknowns();
    march = std::make_unique<TimeMarching>(*system.kernel, *system.history,
                                           system.given->traction_is_given());
    if (state.step > 0)
    {
      system.history->restore(state.history);
      march->restore(to_eigen(state.u), to_eigen(state.p));
      last_displacement
          = march->u()
            + system.waves->displacements(double(state.step) * system.dt);
      return;
    }
    last_displacement = VectorXd::Zero(Eigen::Index(size));
    if (system.needs_record())
    {
      state.all_u.assign(system.n_steps * size, 0.);
      state.all_p.assign(system.n_steps * size, 0.);
    }
    const BoundaryState rest{ last_displacement, last_displacement,
                              last_displacement,
                              VectorXd::Zero(Eigen::Index(size / 2)) };
    if (control.row_is_due(0))
      write_row(0., rest);
    if (control.fields_are_due(0))
      write_boundary(0., rest);
  }

  void BoundaryProblem::march_on()
  {
    const auto start          = WallClock::now();
    const std::uint64_t step  = state.step + 1;
    const double begin        = double(state.step) * system.dt,
                 end          = double(step) * system.dt;
    const VectorXd u_incident = system.waves->displacements(end);
    const VectorXd p_incident = system.waves->tractions(begin, end);
    march->step(system.scattered_values(begin, end, u_incident, p_incident));
    if (!march->u().allFinite() || !march->p().allFinite())
      throw RunError("boundary elements: the solution is not finite any more "
                     "at time "
                     + number_text(end)
                     + " s. If it has grown before, the formulation is not "
                       "stable with this time step: take 'Formulation = "
                       "Galerkin' and a larger 'Step ratio'.");
    if (system.needs_record())
      for (Eigen::Index k = 0; k < march->u().size(); ++k)
      {
        state.all_u[k * system.n_steps + state.step] = march->u()[k];
        state.all_p[k * system.n_steps + state.step] = march->p()[k];
      }
    state.step = step;
    write_step(u_incident, p_incident);
    ++n_done;
    march_seconds += seconds_since(start);
  }

  void BoundaryProblem::write_step(const VectorXd &u_incident,
                                   const VectorXd &p_incident)
  {
    const double end = double(state.step) * system.dt;
    const bool row   = control.row_is_due(state.step),
               all   = control.fields_are_due(state.step);
    BoundaryState fields;
    fields.displacement = march->u() + u_incident;
    if (row || all)
    {
      fields.velocity = (fields.displacement - last_displacement) / system.dt;
      fields.traction = march->p() + p_incident;
      // Displacements are those at the end of the step: so are the tractions
      // where they are known.
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
      write_boundary(end, fields);
    last_displacement = fields.displacement;
  }

  void BoundaryProblem::write_row(const double time,
                                  const BoundaryState &fields)
  {
    const std::vector<double> row = system.histories->row(time, fields);
    if (!system.histories->interior_points().empty())
      state.rows.insert(state.rows.end(), row.begin(), row.end());
    else
      history_table.add_row(row);
  }

  void BoundaryProblem::write_boundary(const double time,
                                       const BoundaryState &fields)
  {
    all_or_none<RunError>(run.communicator,
                          [&]()
                          {
                            if (run.is_first_rank())
                              boundary_output.write(
                                  time,
                                  boundary_fields(system.geometry, fields));
                            history_table.flush();
                          });
  }

  // -- checkpoints and summary ----------------------------------------------

  void BoundaryProblem::complete_state()
  {
    if (!march)
      return;
    state.history = system.history->save();
    state.u       = to_vector(march->u());
    state.p       = to_vector(march->p());
  }

  void BoundaryProblem::save(boost::archive::binary_oarchive &archive)
  {
    archive &state &boundary_output;
  }

  void BoundaryProblem::load(boost::archive::binary_iarchive &archive)
  {
    archive &state &boundary_output;
  }

  void BoundaryProblem::summarise(nlohmann::json &summary,
                                  double /*seconds*/) const
  {
    const VectorXd lengths = system.geometry.boundary.lengths();
    summary.update(
        { { "boundaries", settings.boundaries.size() },
          { "boundary elements", lengths.size() },
          { "boundary length [m]", lengths.sum() },
          { "shortest element [m]", lengths.minCoeff() },
          { "longest element [m]", lengths.maxCoeff() },
          { "P wave speed [m/s]", system.medium.c1 },
          { "S wave speed [m/s]", system.medium.c2 },
          { "points in the domain", system.points_in_domain().size() },
          { "peak memory [B]",
            dealii::Utilities::MPI::max(peak_memory(), run.communicator) } });
    if (settings.is_static)
      summary["wall time [s]"]
          = summary["wall time [s]"].get<double>() + solution_seconds;
    else
      summary.update({ { "time [s]", double(state.step) * system.dt },
                       { "steps", state.step },
                       { "time step [s]", system.dt },
                       { "step ratio, smallest",
                         system.medium.c1 * system.dt / lengths.maxCoeff() },
                       { "step ratio, largest",
                         system.medium.c1 * system.dt / lengths.minCoeff() },
                       { "wall time per step [s]",
                         n_done > 0 ? march_seconds / double(n_done) : 0. } });
    if (const PassivityReport *passivity = system.passivity.get())
      summary["passivity"] = { { "smallest eigenvalue [rho c2]",
                                 passivity->smallest_eigenvalue },
                               { "frequency [Hz]", passivity->frequency },
                               { "highest frequency [Hz]", passivity->nyquist },
                               { "frequencies", passivity->n_scanned } };
  }

  void BoundaryProblem::report_end(const nlohmann::json &summary)
  {
    run.log.message(
        "finished: "
        + (settings.is_static ? std::string("static solution")
                              : std::to_string(state.step) + " steps")
        + " in " + duration_text(summary["wall time [s]"].get<double>()) + ", "
        + number_text(1e-6 * peak_memory()) + " MB");
  }
} // namespace quoin
