// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/farfield/boundary_report.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/boundary_problem/boundary_system.h>
#include <quoin/problems/problem.h>

#include <algorithm>

namespace quoin
{
  using Eigen::VectorXd;

  BoundarySystem::BoundarySystem(const Parameters &parameters,
                                 const MPI_Comm communicator)
    : parameters(parameters), settings(parameters.boundary),
      communicator(communicator), medium(settings.medium)
  {
    naming(parameters.file,
           [&]()
           {
             MeshData<2> mesh;
             if (!parameters.mesh_file.empty())
               mesh = read_gmsh(parameters.mesh_file, communicator,
                                CellOptions(TriangleKind::plain,
                                            parameters.cells.refinements));
             using dealii::Utilities::MPI::broadcast;
             fingerprint
                 = broadcast(communicator, run_fingerprint(parameters, mesh));
             mesh      = broadcast(communicator, curves_of(mesh));
             geometry  = make_boundary_geometry(settings, mesh);
             histories = std::make_unique<BoundaryHistories>(
                 parameters.histories, geometry, settings,
                 parameters.model.thickness);
             hoop_stress = std::make_unique<TangentialStress>(geometry.boundary,
                                                              medium);
             given       = std::make_unique<BoundaryValues>(geometry, settings);
             sampled     = make_domain_points(settings.sampled_field,
                                              geometry.boundary);
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
    // The run ends at a step, not near one.
    const double steps = count_steps(
        settings.duration, settings.wanted_time_step(geometry.boundary), 1e9,
        text_of("section 'Boundary elements': 'Duration = ", settings.duration,
                "'"),
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
    log.messages(stability_lines(settings, geometry.boundary, dt, n_steps));
    /** c1 dt / L beyond which peaks are lost. */
    constexpr double most = 5.;
    const double ratio
        = medium.c1 * dt / geometry.boundary.lengths().maxCoeff();
    if (ratio > most)
      log.warning("P waves pass ", ratio,
                  " of the longest boundary elements in a time step, more than "
                  "5: peaks are cut off. Take a 'Step ratio' of 1, or a "
                  "shorter 'Time step'.");
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

  std::vector<dealii::Point<2>> BoundarySystem::points_in_domain() const
  {
    std::vector<dealii::Point<2>> points = histories->interior_points();
    points.insert(points.end(), sampled.points.begin(), sampled.points.end());
    return points;
  }

  Eigen::MatrixXd BoundarySystem::domain_displacements(
      const BoundaryRecord &all, const std::vector<dealii::Point<2>> &points,
      const std::vector<unsigned int> &steps) const
  {
    Eigen::MatrixXd u = interior_displacements(geometry.boundary, medium, all,
                                               points, steps, communicator);
    for (std::size_t k = 0; k < points.size(); ++k)
      for (std::size_t l = 0; l < steps.size(); ++l)
      {
        auto column = u.col(l);
        add_to_vector(column, k, waves->displacement(points[k], steps[l] * dt));
      }
    return u;
  }
} // namespace quoin
