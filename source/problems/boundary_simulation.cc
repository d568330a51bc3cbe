// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/boundary_report.h>
#include <quoin/problems/boundary_simulation.h>
#include <quoin/problems/model_summary.h>
#include <quoin/problems/open_log.h>
#include <quoin/problems/step_count.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/tdbem/plain_vector.h>
#include <quoin/tdbem/static_solver.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Eigen::VectorXd;

    /**
     * Where tractions are given: c_2 dt / L from which no growth has been seen
     * outside of holes in 30000 steps, for boundaries of up to 64 elements and
     * for longer ones; and for how many steps none was seen with any. Bounded
     * domains may grow at any ratio (doc/boundary_elements.md).
     */
    constexpr double stable_shear_ratio         = 0.55;
    constexpr double stable_shear_ratio_of_many = 0.85;
    constexpr std::size_t few_elements          = 64;
    constexpr std::uint64_t steady_steps        = 500;

    /** Runs @p task and puts the file's name before its complaints. */
    template <typename Task>
    void naming(const std::string &file, const Task &task)
    {
      try
      {
        task();
      }
      catch (const InputError &error)
      {
        throw InputError(file + ", " + error.what());
      }
    }
  } // namespace

  BoundarySimulation::BoundarySimulation(const Parameters &parameters,
                                         const RunOptions &options,
                                         const MPI_Comm communicator)
    : parameters(parameters), settings(this->parameters.boundary),
      options(options), communicator(communicator),
      is_first_rank(dealii::Utilities::MPI::this_mpi_process(communicator)
                    == 0),
      output(parameters.output_directory), log(is_first_rank, options.quiet),
      progress(log), field_output(output, MPI_COMM_SELF),
      history_control(parameters.history_interval),
      field_control(parameters.field_interval > 0. ? parameters.field_interval
                                                   : -1.),
      record{ 0,  {},   {},
              {}, {},   {},
              {}, {},   BoundaryOutput(output, MPI_COMM_SELF),
              0., false },
      checkpoint_clock(parameters.checkpoint_interval, communicator)
  {
  }

  void BoundarySimulation::run()
  {
    naming(parameters.file, [&]() { make_boundary(); });
    report();
    naming(parameters.file,
           [&]() { settings.is_static ? solve_static() : make_operators(); });
    if (options.check)
      return report_costs();
    open_outputs();
    if (record.finished)
    {
      log.message("the run had finished: nothing is left to do");
      return;
    }
    checkpoint_clock.restart();
    write_summary();
    if (settings.is_static)
      write_static();
    else
    {
      naming(parameters.file, [&]() { make_march(); });
      progress.start(progress_figures());
      while (record.step < n_steps)
      {
        take_step();
        if (progress.due())
          progress.update(progress_figures());
        checkpoint_if_due();
      }
      progress.finish(progress_figures());
      if (needs_record())
      {
        // What follows takes long and begins anew from here if interrupted.
        save_checkpoint();
        write_domain();
      }
    }
    record.finished = true;
    write_summary();
    // There is nothing to resume.
    march.reset();
    record.history = {};
    save_checkpoint();
  }

  // -- before the first step ------------------------------------------------

  void BoundarySimulation::make_boundary()
  {
    for (const MaterialParameters &material : parameters.model.materials)
      if (material.name == settings.material)
        medium = ElasticMedium::from_young(material.elastic.density,
                                           material.elastic.young,
                                           material.elastic.poisson);
    MeshData mesh;
    if (!parameters.mesh_file.empty())
      mesh = read_gmsh(parameters.mesh_file, communicator);
    run_identity = run_fingerprint(parameters, mesh);
    geometry     = make_boundary_geometry(settings, mesh);
    histories    = std::make_unique<BoundaryHistories>(
        parameters.histories, geometry, settings, parameters.model.thickness);
    hoop_stress = std::make_unique<TangentialStress>(geometry.boundary, medium);
    given       = std::make_unique<BoundaryValues>(geometry, settings);
    make_sampled_points();
    if (settings.is_static)
      return;
    choose_time_step();
    given->check_start();
    waves = std::make_unique<IncidentWaves>(settings, medium, geometry.boundary,
                                            points_in_domain(),
                                            settings.duration, dt);
  }

  void BoundarySimulation::choose_time_step()
  {
    const double wanted = wanted_time_step(settings, geometry.boundary, medium);
    // The run ends at a step, not near one.
    const double steps
        = count_steps(settings.duration, wanted, 1e9,
                      "section 'Boundary elements': 'Duration = "
                          + number_text(settings.duration) + "'",
                      "Give a larger 'Time step', or a shorter duration.");
    n_steps = std::uint64_t(steps);
    dt      = settings.duration / steps;
  }

  bool BoundarySimulation::needs_record() const
  {
    return !sampled_points.empty() || !histories->interior_points().empty();
  }

  void BoundarySimulation::report()
  {
    log.message(parameters.title.empty() ? parameters.file : parameters.title);
    const VectorXd lengths = geometry.boundary.lengths();
    for (unsigned int k = 0; k < settings.boundaries.size(); ++k)
    {
      unsigned int n = 0;
      double total = 0., least = 1e300, most = 0.;
      for (unsigned int e = 0; e < geometry.owner.size(); ++e)
        if (geometry.owner[e] == k)
        {
          ++n;
          total += lengths[e];
          least = std::min(least, lengths[e]);
          most  = std::max(most, lengths[e]);
        }
      log.message(
          "boundary " + settings.boundaries[k].name + ": " + std::to_string(n)
          + " elements over " + number_text(total) + " m, "
          + (most - least < 1e-6 * most
                 ? "each " + number_text(most)
                 : "from " + number_text(least) + " to " + number_text(most))
          + " m");
    }
    for (const MaterialParameters &material : parameters.model.materials)
      if (material.name == settings.material)
        log.message("material " + material.name + ": "
                    + material_text(material, parameters.model.plane));
    if (options.check)
      for (const std::string &line :
           boundary_lines(settings, geometry, settings.duration))
        log.message(line);
    if (!sampled_points.empty())
      log.message("sampled field: " + std::to_string(sampled_points.size())
                  + " points");
    if (settings.is_static)
      return;
    advise();
    log.message("time step " + number_text(dt) + " s, "
                + step_ratio_text(geometry.boundary, medium, dt) + ", "
                + std::to_string(n_steps) + " steps");
    for (const std::string &text : waves->reports())
      log.message(text);
    if (needs_record())
      log.message("record of the boundary: "
                  + number_text(2e-6 * double(sizeof(double)) * double(n_steps)
                                * double(geometry.boundary.n_unknowns()))
                  + " MB");
  }

  void BoundarySimulation::make_operators()
  {
    FormulationOptions formulation = settings.formulation_options();
    formulation.time_step          = dt;
    formulation.n_steps            = n_steps;
    kernel = make_lag_kernel(geometry.boundary, medium, formulation);
    history
        = make_history(*kernel, geometry.boundary, formulation, communicator);
    passivity
        = passivity_of(*kernel, *history, geometry.boundary, medium,
                       formulation, dt, settings.n_frequencies, communicator);
    if (passivity)
      log.message(passivity->advice());
    report_stability();
  }

  void BoundarySimulation::report_stability()
  {
    const auto &of_traction = given->traction_is_given();
    if (settings.formulation == Formulation::convolution_quadrature
        || std::none_of(of_traction.begin(), of_traction.end(),
                        [](const bool given) { return given; }))
      return;
    const double ratio
        = medium.c2 * dt / geometry.boundary.lengths().maxCoeff();
    const double needed = geometry.boundary.n_elements() <= few_elements
                              ? stable_shear_ratio
                              : stable_shear_ratio_of_many;
    if (settings.formulation == Formulation::collocation)
      log.message("Tractions are given: with collocation motion may grow "
                  "without end. Take Galerkin or convolution quadrature.");
    else if (n_steps > steady_steps && (is_bounded() || ratio < needed))
      log.message(
          "Tractions are given"
          + (is_bounded() ? std::string(" on a bounded domain")
                          : " and c2 dt / L is " + number_text(ratio)
                                + " on the longest element, below "
                                + number_text(needed))
          + ": motion may grow slowly after some hundred to thousand steps. "
          + (is_bounded() ? "" : "Take longer steps, or ")
          + (is_bounded() ? "Take " : "")
          + "convolution quadrature for long runs.");
  }

  bool BoundarySimulation::is_bounded() const
  {
    return std::any_of(settings.boundaries.begin(), settings.boundaries.end(),
                       [](const BoundaryCurveParameters &curve)
                       { return curve.domain == DomainSide::inside; })
           || std::none_of(settings.boundaries.begin(),
                           settings.boundaries.end(),
                           [](const BoundaryCurveParameters &curve)
                           { return curve.domain == DomainSide::outside; });
  }

  void BoundarySimulation::make_march()
  {
    march                  = std::make_unique<TimeMarching>(*kernel, *history,
                                           given->traction_is_given());
    const std::size_t size = geometry.boundary.n_unknowns();
    if (record.step > 0)
    {
      history->restore(record.history);
      march->restore(to_eigen(record.u), to_eigen(record.p));
      last_displacement = march->u() + waves->displacements(record.step * dt);
      return;
    }
    last_displacement = VectorXd::Zero(Eigen::Index(size));
    if (needs_record())
    {
      record.all_u.assign(n_steps * size, 0.);
      record.all_p.assign(n_steps * size, 0.);
    }
    const BoundaryState rest{ last_displacement, last_displacement,
                              last_displacement,
                              VectorXd::Zero(Eigen::Index(size / 2)) };
    if (row_is_due(0))
      write_row(0., rest);
    if (fields_are_due(0))
      write_boundary(0., rest);
  }

  // -- the time loop --------------------------------------------------------

  bool BoundarySimulation::row_is_due(const std::uint64_t step) const
  {
    return step == n_steps || history_control.is_due(step * dt, dt);
  }

  bool BoundarySimulation::fields_are_due(const std::uint64_t step) const
  {
    return step == n_steps || field_control.is_due(step * dt, dt);
  }

  VectorXd BoundarySimulation::scattered_values(const double begin,
                                                const double end,
                                                const VectorXd &u_incident,
                                                const VectorXd &p_incident)
  {
    VectorXd values         = (*given)(begin, end);
    const auto &of_traction = given->traction_is_given();
    for (Eigen::Index k = 0; k < values.size(); ++k)
      values[k] -= of_traction[k] ? p_incident[k] : u_incident[k];
    return values;
  }

  void BoundarySimulation::take_step()
  {
    const auto start         = WallClock::now();
    const std::uint64_t step = record.step + 1;
    const double begin = record.step * dt, end = step * dt;
    const VectorXd u_incident = waves->displacements(end);
    const VectorXd p_incident = waves->tractions(begin, end);
    const auto &of_traction   = given->traction_is_given();
    march->step(scattered_values(begin, end, u_incident, p_incident));
    if (!march->u().allFinite() || !march->p().allFinite())
      throw RunError("boundary elements: the solution is not finite any more "
                     "at time "
                     + number_text(end)
                     + " s. If it has grown before, the formulation is not "
                       "stable with this time step: take 'Formulation = "
                       "Galerkin' and a larger 'Step ratio'.");
    if (needs_record())
      for (Eigen::Index k = 0; k < march->u().size(); ++k)
      {
        record.all_u[k * n_steps + record.step] = march->u()[k];
        record.all_p[k * n_steps + record.step] = march->p()[k];
      }
    record.step = step;

    BoundaryState state;
    state.displacement = march->u() + u_incident;
    if (row_is_due(step) || fields_are_due(step))
    {
      state.velocity = (state.displacement - last_displacement) / dt;
      state.traction = march->p() + p_incident;
      // Displacements are those at the end of the step: so are the tractions
      // where they are known.
      VectorXd p_end         = state.traction;
      const VectorXd p_given = given->at(end);
      for (Eigen::Index k = 0; k < p_end.size(); ++k)
        if (of_traction[k])
          p_end[k] = p_given[k];
      state.hoop_stress = (*hoop_stress)(state.displacement, p_end);
      if (row_is_due(step))
        write_row(end, state);
      if (fields_are_due(step))
        write_boundary(end, state);
    }
    last_displacement    = state.displacement;
    const double seconds = seconds_since(start);
    record.wall_time += seconds;
    seconds_done += seconds;
    ++steps_done;
  }

  void BoundarySimulation::solve_static()
  {
    const auto start = WallClock::now();
    StaticConditions conditions;
    conditions.values = (*given)(settings.duration, settings.duration);
    for (const bool traction : given->traction_is_given())
      conditions.displacement_known.push_back(!traction);
    static_solution = std::make_unique<StaticSolution>(
        quoin::solve_static(geometry.boundary, medium,
                            settings.formulation == Formulation::collocation
                                ? Projection::collocation
                                : Projection::galerkin,
                            conditions));
    record.wall_time = seconds_since(start);
  }

  ProgressFigures BoundarySimulation::progress_figures() const
  {
    ProgressFigures figures;
    figures.stage    = "boundary elements";
    figures.time     = record.step * dt;
    figures.step     = record.step;
    figures.fraction = double(record.step) / double(n_steps);
    return figures;
  }
} // namespace quoin
