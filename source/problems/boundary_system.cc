// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/problems/boundary_report.h>
#include <quoin/problems/boundary_system.h>
#include <quoin/problems/problem.h>
#include <quoin/problems/run_fingerprint.h>
#include <quoin/problems/step_count.h>

#include <algorithm>

namespace quoin
{
  using Eigen::Vector2d;
  using Eigen::VectorXd;

  namespace
  {
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
  } // namespace

  BoundarySystem::BoundarySystem(const Parameters &parameters,
                                 const MPI_Comm communicator)
    : parameters(parameters), settings(parameters.boundary),
      communicator(communicator)
  {
    naming(
        parameters.file,
        [&]()
        {
          for (const MaterialParameters &material : parameters.model.materials)
            if (material.name == settings.material)
              medium = ElasticMedium::from_young(material.elastic.density,
                                                 material.elastic.young,
                                                 material.elastic.poisson);
          MeshData mesh;
          if (!parameters.mesh_file.empty())
            mesh = read_gmsh(parameters.mesh_file, communicator);
          using dealii::Utilities::MPI::broadcast;
          fingerprint
              = broadcast(communicator, run_fingerprint(parameters, mesh));
          mesh      = broadcast(communicator, curves_of(mesh));
          geometry  = make_boundary_geometry(settings, mesh);
          histories = std::make_unique<BoundaryHistories>(
              parameters.histories, geometry, settings,
              parameters.model.thickness);
          hoop_stress
              = std::make_unique<TangentialStress>(geometry.boundary, medium);
          given = std::make_unique<BoundaryValues>(geometry, settings);
          sampled
              = make_domain_points(settings.sampled_field, geometry.boundary);
          if (settings.is_static)
            return;
          choose_time_step();
          given->check_start();
          waves = std::make_unique<IncidentWaves>(
              settings, medium, geometry.boundary, points_in_domain(),
              settings.duration, dt);
        });
  }

  void BoundarySystem::choose_time_step()
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

  void BoundarySystem::make_operators(Log &log)
  {
    naming(parameters.file,
           [&]()
           {
             FormulationOptions formulation = settings.formulation_options();
             formulation.time_step          = dt;
             formulation.n_steps            = n_steps;
             kernel  = make_lag_kernel(geometry.boundary, medium, formulation);
             history = make_history(*kernel, geometry.boundary, formulation,
                                    communicator);
             passivity = passivity_of(*kernel, *history, geometry.boundary,
                                      medium, formulation, dt,
                                      settings.n_frequencies, communicator);
           });
    if (passivity)
      log.message(passivity->advice());
    report_stability(log);
  }

  void BoundarySystem::report_stability(Log &log) const
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

  bool BoundarySystem::is_bounded() const
  {
    return std::any_of(settings.boundaries.begin(), settings.boundaries.end(),
                       [](const BoundaryCurveParameters &curve)
                       { return curve.domain == DomainSide::inside; })
           || std::none_of(settings.boundaries.begin(),
                           settings.boundaries.end(),
                           [](const BoundaryCurveParameters &curve)
                           { return curve.domain == DomainSide::outside; });
  }

  VectorXd BoundarySystem::scattered_values(const double begin,
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

  StaticSolution BoundarySystem::solve_static()
  {
    StaticConditions conditions;
    conditions.values = (*given)(settings.duration, settings.duration);
    for (const bool traction : given->traction_is_given())
      conditions.displacement_known.push_back(!traction);
    return quoin::solve_static(geometry.boundary, medium,
                               settings.formulation == Formulation::collocation
                                   ? Projection::collocation
                                   : Projection::galerkin,
                               conditions);
  }

  bool BoundarySystem::needs_record() const
  {
    return !sampled.points.empty() || !histories->interior_points().empty();
  }

  std::vector<Vector2d> BoundarySystem::points_in_domain() const
  {
    std::vector<Vector2d> points = histories->interior_points();
    points.insert(points.end(), sampled.points.begin(), sampled.points.end());
    return points;
  }

  Eigen::MatrixXd BoundarySystem::domain_displacements(
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
} // namespace quoin
