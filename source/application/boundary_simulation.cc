// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/boundary_simulation.h>
#include <quoin/base/exceptions.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/collective.h>
#include <quoin/output/json_file.h>
#include <quoin/tdbem/static_solver.h>

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace quoin
{
  namespace
  {
    using Clock = std::chrono::steady_clock;
    using Eigen::Vector2d;
    using Eigen::VectorXd;

    /** Steps between looks at the clock for a checkpoint. */
    constexpr std::uint64_t clock_interval = 16;
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
    /** Points of the sampled field that are computed at a time. */
    constexpr std::size_t batch_size = 256;

    double seconds_since(const Clock::time_point start)
    {
      return std::chrono::duration<double>(Clock::now() - start).count();
    }

    std::string number(const double value)
    {
      std::ostringstream text;
      text.precision(4);
      text << value;
      return text.str();
    }

    std::vector<double> to_vector(const VectorXd &values)
    {
      return { values.data(), values.data() + values.size() };
    }

    VectorXd to_eigen(const std::vector<double> &values)
    {
      return VectorXd::Map(values.data(), Eigen::Index(values.size()));
    }

    std::vector<std::array<double, 2>> pairs(const VectorXd &values)
    {
      std::vector<std::array<double, 2>> result(values.size() / 2);
      for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = { { values[2 * k], values[2 * k + 1] } };
      return result;
    }

    /** Largest memory that this process has had [B]. */
    double peak_memory()
    {
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * double(usage.ru_maxrss);
    }

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
              {}, 0,    BoundaryOutput(output, MPI_COMM_SELF),
              0., false }
  {
  }

  void BoundarySimulation::run()
  {
    naming(parameters.file, [&]() { make_boundary(); });
    report();
    naming(parameters.file,
           [&]() { settings.is_static ? solve_static() : make_operators(); });
    if (options.check)
      return;
    open_outputs();
    if (record.finished)
    {
      log.message("the run had finished: nothing is left to do");
      return;
    }
    last_checkpoint = Clock::now();
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
    geometry  = make_boundary_geometry(settings, mesh);
    histories = std::make_unique<BoundaryHistories>(
        parameters.histories, geometry, settings, parameters.model.thickness);
    hoop_stress = std::make_unique<TangentialStress>(geometry.boundary, medium);
    given       = std::make_unique<GivenValues>(geometry, settings);
    make_sampled_points();
    if (settings.is_static)
      return;
    choose_time_step();
    given->check_start();
    waves = std::make_unique<IncidentWaves>(settings, medium, geometry.boundary,
                                            points_in_domain(),
                                            settings.duration, dt);
  }

  void BoundarySimulation::make_sampled_points()
  {
    const SampledFieldParameters &field = settings.sampled_field;
    if (!field.has_box)
      return;
    const Boundary &boundary = geometry.boundary;
    const unsigned int nx
        = 1 + std::floor((field.box[2] - field.box[0]) / field.spacing + 1e-9);
    const unsigned int ny
        = 1 + std::floor((field.box[3] - field.box[1]) / field.spacing + 1e-9);
    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> point(nx * ny, none);
    std::vector<double> distance; // of each point to the boundary
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
      {
        const Vector2d x(field.box[0] + i * field.spacing,
                         field.box[1] + j * field.spacing);
        const NearestElement nearest = nearest_element(boundary, x);
        if (!nearest.inside_domain
            || nearest.distance
                   < 0.25 * boundary.elements[nearest.element].length())
          continue;
        point[j * nx + i] = sampled_points.size();
        sampled_points.push_back(x);
        distance.push_back(nearest.distance);
        sampled.position.push_back({ { x.x(), x.y() } });
      }
    // Triangles, unless they lie across the boundary.
    const auto add = [&](const std::array<std::int32_t, 3> &triangle)
    {
      bool near = false;
      for (const std::int32_t p : triangle)
      {
        if (p == none)
          return;
        near = near || distance[p] < 2. * field.spacing;
      }
      for (unsigned int k = 0; near && k < 3; ++k)
        for (const BoundaryElement &element : boundary.elements)
          if (segments_meet(sampled_points[triangle[k]],
                            sampled_points[triangle[(k + 1) % 3]], element.a,
                            element.b))
            return;
      sampled.triangles.push_back(triangle);
    };
    for (unsigned int j = 0; j + 1 < ny; ++j)
      for (unsigned int i = 0; i + 1 < nx; ++i)
      {
        const std::int32_t a = point[j * nx + i], b = point[j * nx + i + 1],
                           c = point[(j + 1) * nx + i + 1],
                           d = point[(j + 1) * nx + i];
        // The diagonal that leaves a triangle if one corner is missing.
        if (b == none || d == none)
          add({ { a, b == none ? c : b, d == none ? c : d } });
        else
        {
          add({ { a, b, d } });
          add({ { b, c, d } });
        }
      }
    if (sampled_points.empty())
      throw InputError("section 'Sampled field': no point of 'Box' is in the "
                       "domain, a quarter of an element from the boundary or "
                       "farther. Move it, or give a smaller 'Spacing'.");
  }

  void BoundarySimulation::choose_time_step()
  {
    const double wanted = settings.time_step > 0.
                              ? settings.time_step
                              : settings.step_ratio
                                    * geometry.boundary.lengths().minCoeff()
                                    / medium.c1;
    // The run ends at a step, not near one.
    const double steps = std::ceil(settings.duration / wanted * (1. - 1e-12));
    if (!(steps < 1e9))
      throw InputError("section 'Boundary elements': 'Duration = "
                       + number(settings.duration) + "' takes " + number(steps)
                       + " time steps. Give a larger 'Time step', or a "
                         "shorter duration.");
    n_steps = std::uint64_t(steps);
    dt      = settings.duration / steps;
  }

  std::vector<Vector2d> BoundarySimulation::points_in_domain() const
  {
    std::vector<Vector2d> points = histories->interior_points();
    points.insert(points.end(), sampled_points.begin(), sampled_points.end());
    return points;
  }

  FormulationOptions BoundarySimulation::formulation_options() const
  {
    FormulationOptions result;
    result.formulation    = settings.formulation;
    result.time_step      = dt;
    result.decay          = settings.decay;
    result.damping        = settings.damping;
    result.direct_history = settings.direct_history;
    result.tolerance      = settings.tolerance;
    result.n_steps        = n_steps;
    return result;
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
      log.message("boundary " + settings.boundaries[k].name + ": "
                  + std::to_string(n) + " elements over " + number(total)
                  + " m, "
                  + (most - least < 1e-6 * most
                         ? "each " + number(most)
                         : "from " + number(least) + " to " + number(most))
                  + " m");
    }
    log.message("material " + settings.material + ": P waves "
                + number(medium.c1) + " m/s, S waves " + number(medium.c2)
                + " m/s");
    if (!sampled_points.empty())
      log.message("sampled field: " + std::to_string(sampled_points.size())
                  + " points");
    if (settings.is_static)
      return;
    const double low  = medium.c1 * dt / lengths.maxCoeff();
    const double high = medium.c1 * dt / lengths.minCoeff();
    log.message("time step " + number(dt) + " s, c1 dt / L "
                + (high - low < 1e-6 * high
                       ? number(high)
                       : "from " + number(low) + " to " + number(high))
                + ", " + std::to_string(n_steps) + " steps");
    for (const std::string &text : waves->reports())
      log.message(text);
    if (needs_record())
      log.message("record of the boundary: "
                  + number(2e-6 * double(sizeof(double)) * double(n_steps)
                           * double(geometry.boundary.n_unknowns()))
                  + " MB");
  }

  void BoundarySimulation::make_operators()
  {
    const FormulationOptions formulation = formulation_options();
    kernel = make_lag_kernel(geometry.boundary, medium, formulation);
    history
        = make_history(*kernel, geometry.boundary, formulation, communicator);
    report_passivity();
    report_stability();
  }

  void BoundarySimulation::report_passivity()
  {
    if (settings.n_frequencies == 0)
      return;
    // As wide as the scan needs to miss little: what rings at a frequency is
    // seen from the next one.
    const double radius = 1. - 0.5 / double(settings.n_frequencies);
    const ZTransform transform
        = make_transform(*kernel, *history, geometry.boundary, medium,
                         formulation_options(), communicator);
    passivity = std::make_unique<PassivityReport>(
        scan_passivity(transform, geometry.boundary, medium, dt,
                       settings.n_frequencies, radius));
    log.message(passivity->advice());
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
          + (is_bounded()
                 ? std::string(" on a bounded domain")
                 : " and c2 dt / L is " + number(ratio)
                       + " on the longest element, below " + number(needed))
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
    march                  = std::make_unique<BoundaryMarch>(*kernel, *history,
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

  void BoundarySimulation::open_outputs()
  {
    all_or_none<InputError>(
        communicator,
        [&]()
        {
          std::error_code error;
          if (is_first_rank)
          {
            std::filesystem::create_directories(output, error);
            if (!std::filesystem::is_directory(output))
              throw InputError("the output directory '" + output
                               + "' cannot be made: " + error.message()
                               + ". Choose another with 'Output directory' or "
                                 "--output.");
          }
        });
    history_table = std::make_unique<CsvTable>(output + "/histories.csv",
                                               histories->column_names());
    if (options.resume)
    {
      const CheckpointInfo info
          = load_checkpoint(output, communicator, QUOIN_VERSION,
                            fingerprint(parameters.effective), record);
      all_or_none<RunError>(communicator,
                            [&]() { log.open(output + "/log.txt", true); });
      log.message("resumed at time " + number(info.time) + " s, step "
                  + std::to_string(info.step));
    }
    else
      all_or_none<RunError>(communicator,
                            [&]() { log.open(output + "/log.txt", false); });
    all_or_none<RunError>(
        communicator,
        [&]()
        {
          if (!is_first_rank)
            return;
          if (options.resume)
            history_table->resume(record.histories_bytes);
          else
          {
            std::filesystem::remove_all(output + "/checkpoint");
            std::filesystem::remove(output + "/field.pvd");
            history_table->start();
          }
          std::ofstream used(output + "/used_parameters.prm");
          used << parameters.effective;
          used.close();
          if (!used)
            throw RunError("'" + output
                           + "/used_parameters.prm' cannot be written. Is the "
                             "disk full?");
          record.boundary_output.start();
        });
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

  void BoundarySimulation::take_step()
  {
    const auto start         = Clock::now();
    const std::uint64_t step = record.step + 1;
    const double begin = record.step * dt, end = step * dt;
    const VectorXd u_incident = waves->displacements(end);
    const VectorXd p_incident = waves->tractions(begin, end);
    VectorXd values           = (*given)(begin, end);
    const auto &of_traction   = given->traction_is_given();
    for (Eigen::Index k = 0; k < values.size(); ++k)
      values[k] -= of_traction[k] ? p_incident[k] : u_incident[k];
    march->step(values);
    if (!march->u().allFinite() || !march->p().allFinite())
      throw RunError("boundary elements: the solution is not finite any more "
                     "at time "
                     + number(end)
                     + " s. If it has grown before, the formulation is not "
                       "stable with this time step: take 'Formulation = "
                       "Galerkin' and a larger 'Step ratio'.");
    if (needs_record())
      for (Eigen::Index k = 0; k < values.size(); ++k)
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
    const auto start = Clock::now();
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
    all_or_none<RunError>(
        communicator,
        [&]()
        {
          if (!is_first_rank)
            return;
          BoundaryFields fields;
          for (unsigned int e = 0; e < geometry.owner.size(); ++e)
          {
            const BoundaryElement &element = geometry.boundary.elements[e];
            fields.a.push_back({ { element.a.x(), element.a.y() } });
            fields.b.push_back({ { element.b.x(), element.b.y() } });
            fields.boundary.push_back(std::int32_t(geometry.owner[e]));
          }
          fields.displacement = pairs(state.displacement);
          fields.velocity     = pairs(state.velocity);
          fields.traction     = pairs(state.traction);
          fields.hoop_stress  = to_vector(state.hoop_stress);
          record.boundary_output.write(time, fields);
          history_table->flush();
        });
  }

  void BoundarySimulation::checkpoint_if_due()
  {
    if (parameters.checkpoint_interval == 0.
        || record.step % clock_interval != 0)
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
    info.parameters = fingerprint(parameters.effective);
    quoin::save_checkpoint(output, communicator, info, record);
    last_checkpoint = Clock::now();
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

  // -- the domain, after the time loop --------------------------------------

  void BoundarySimulation::write_domain()
  {
    const Eigen::Index size = Eigen::Index(geometry.boundary.n_unknowns());
    BoundaryRecord all{ dt, settings.decay, {}, {} };
    all.displacement = Eigen::MatrixXd::Map(record.all_u.data(),
                                            Eigen::Index(n_steps), size);
    all.traction     = Eigen::MatrixXd::Map(record.all_p.data(),
                                            Eigen::Index(n_steps), size);
    // The next checkpoint is that of a finished run.
    record.all_u   = {};
    record.all_p   = {};
    record.history = {};
    if (!histories->interior_points().empty())
      write_histories(all);
    if (!sampled_points.empty())
      write_sampled_fields(all);
  }

  Eigen::MatrixXd BoundarySimulation::domain_displacements(
      const BoundaryRecord &all, const std::vector<Vector2d> &points,
      const std::vector<unsigned int> &steps) const
  {
    Eigen::MatrixXd u = interior_displacements(geometry.boundary, medium, all,
                                               points, steps, communicator);
    for (std::size_t k = 0; k < points.size(); ++k)
      for (std::size_t l = 0; l < steps.size(); ++l)
        u.block<2, 1>(2 * k, l)
            += waves->displacement(points[k], steps[l] * dt);
    return u;
  }

  void BoundarySimulation::write_histories(const BoundaryRecord &all)
  {
    // A step and, for the velocity, the one before it.
    std::vector<unsigned int> steps;
    std::vector<std::array<std::size_t, 2>> columns;
    for (std::uint64_t step = 0; step <= n_steps; ++step)
      if (row_is_due(step))
      {
        std::array<std::size_t, 2> column{};
        for (const unsigned int k : { 1U, 0U })
        {
          const unsigned int wanted = static_cast<unsigned int>(
              step - std::min<std::uint64_t>(k, step));
          if (steps.empty() || steps.back() != wanted)
            steps.push_back(wanted);
          column[k] = steps.size() - 1;
        }
        columns.push_back(column);
      }
    const Eigen::MatrixXd u
        = domain_displacements(all, histories->interior_points(), steps);
    const std::size_t n_columns = histories->column_names().size();
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            history_table->start();
                            for (std::size_t r = 0; r < columns.size(); ++r)
                            {
                              const auto begin
                                  = record.rows.begin() + r * n_columns;
                              std::vector<double> row(begin, begin + n_columns);
                              const VectorXd now = u.col(columns[r][0]);
                              histories->set_interior(
                                  row, now, (now - u.col(columns[r][1])) / dt);
                              history_table->add_row(row);
                            }
                            history_table->flush();
                          });
    record.rows = {};
  }

  void BoundarySimulation::write_sampled_fields(const BoundaryRecord &all)
  {
    std::vector<double> times;
    std::vector<unsigned int> steps; // the one before, and the step
    for (std::uint64_t step = 0; step <= n_steps; ++step)
      if (fields_are_due(step))
      {
        times.push_back(step * dt);
        steps.push_back(static_cast<unsigned int>(step == 0 ? 0 : step - 1));
        steps.push_back(static_cast<unsigned int>(step));
      }
    ProgressFigures figures = progress_figures();
    figures.stage           = "field in the domain";
    figures.fraction        = 0.;
    progress.start(figures);
    Eigen::MatrixXd u(2 * sampled_points.size(), steps.size());
    for (std::size_t begin = 0; begin < sampled_points.size();
         begin += batch_size)
    {
      const std::size_t end
          = std::min(begin + batch_size, sampled_points.size());
      u.middleRows(2 * begin, 2 * (end - begin)) = domain_displacements(
          all, { sampled_points.begin() + begin, sampled_points.begin() + end },
          steps);
      figures.fraction = double(end) / double(sampled_points.size());
      if (progress.due())
        progress.update(figures);
    }
    progress.finish(figures);
    for (std::size_t frame = 0; frame < times.size(); ++frame)
      write_sampled_field(times[frame], u.col(2 * frame + 1),
                          (u.col(2 * frame + 1) - u.col(2 * frame)) / dt);
  }

  void BoundarySimulation::write_sampled_field(const double time,
                                               const VectorXd &displacement,
                                               const VectorXd &velocity)
  {
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            if (field_output.n_written() == 0)
                              field_output.start();
                            sampled.displacement = pairs(displacement);
                            sampled.velocity     = pairs(velocity);
                            field_output.write(time, sampled);
                          });
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
                + number(1e-6 * peak_memory()) + " MB");
  }
} // namespace quoin
