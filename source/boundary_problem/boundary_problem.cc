// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/known_names.h>
#include <quoin/advice/advice.h>
#include <quoin/farfield/boundary_report.h>
#include <quoin/boundary_problem/boundary_problem.h>
#include <quoin/boundary_problem/boundary_costs.h>
#include <quoin/operators/archive.h>
#include <quoin/results/measurements.h>
#include <quoin/tdbem/plain_vector.h>

#include <nlohmann/json.hpp>

namespace quoin
{
  BoundaryProblem::BoundaryProblem(const Parameters &parameters,
                                   const RunContext &run)
    : Problem(parameters, run), settings(parameters.boundary),
      context(parameters, run), system(context.system)
  {
  }

  const std::string &BoundaryProblem::fingerprint() const
  {
    return system.fingerprint;
  }

  unsigned int BoundaryProblem::n_stages() const
  {
    return !settings.is_static && system.needs_record() ? 2 : 1;
  }

  std::unique_ptr<Stage> BoundaryProblem::make_stage(const unsigned int index)
  {
    return index == 1           ? make_domain_stage(context)
           : settings.is_static ? make_static_stage(context)
                                : make_marching_stage(context);
  }

  void BoundaryProblem::report_model()
  {
    run.log.messages(boundary_lengths(settings, system.geometry));
    run.log.message("material ", settings.material, ": ",
                    material_text(*find_named(parameters.model.materials,
                                              settings.material),
                                  parameters.model.plane));
    if (run.options.check)
      run.log.messages(
          boundary_lines(settings, system.geometry, settings.duration));
    if (!system.sampled.points.empty())
      run.log.message("sampled field: ", system.sampled.points.size(),
                      " points");
    if (settings.is_static)
    {
      context.seconds += context.measured(
          "solve",
          [&]()
          {
            naming(parameters.file,
                   [&]() { context.solution = system.solve_static(); });
          });
      return;
    }
    report_steps();
    context.seconds += context.measured("matrices", [&]()
                                        { system.make_operators(run.log); });
  }

  void BoundaryProblem::report_steps()
  {
    const Boundary &boundary = system.geometry.boundary;
    run.log.warnings(boundary_advice(settings, system.geometry,
                                     settings.duration,
                                     wants_hoop_stress(parameters)));
    run.log.message("time step ", system.dt, " s, ",
                    step_ratio_text(boundary, system.medium, system.dt), ", ",
                    system.n_steps, " steps");
    run.log.messages(system.waves->reports());
    if (system.needs_record())
      run.log.message("record of the boundary: ",
                      2e-6 * double(sizeof(double)) * double(system.n_steps)
                          * double(boundary.n_unknowns()),
                      " MB");
  }

  void BoundaryProblem::report_costs()
  {
    if (!settings.is_static)
      report_boundary_costs(system, context.control, run);
  }

  void BoundaryProblem::open_outputs()
  {
    run.on_first_rank([&]() { context.boundary_output.start(); });
  }

  void BoundaryProblem::complete_state()
  {
    if (!context.marching)
      return;
    context.state.history = system.history->save();
    context.state.u       = to_vector(context.marching->u());
    context.state.p       = to_vector(context.marching->p());
  }

  void BoundaryProblem::save(boost::archive::binary_oarchive &archive)
  {
    archive &context.state &context.boundary_output;
  }

  void BoundaryProblem::load(boost::archive::binary_iarchive &archive,
                             const ArchiveOrigin &origin)
  {
    // The part of the history of other ranks is joined to this one.
    SavedHistory later = std::move(context.state.history);
    archive &context.state &context.boundary_output;
    if (!origin.is_own && origin.rank + 1 < origin.n_ranks)
    {
      auto &groups = context.state.history.groups;
      groups.insert(groups.end(), later.groups.begin(), later.groups.end());
    }
  }

  void BoundaryProblem::summarise(nlohmann::ordered_json &summary,
                                  const double seconds) const
  {
    const Eigen::VectorXd lengths = system.geometry.boundary.lengths();
    summary.update(
        { { "boundaries", settings.boundaries.size() },
          { "boundary elements", lengths.size() },
          { "boundary length [m]", lengths.sum() },
          { "shortest element [m]", lengths.minCoeff() },
          { "longest element [m]", lengths.maxCoeff() },
          { "P wave speed [m/s]", system.medium.c1 },
          { "S wave speed [m/s]", system.medium.c2 },
          { "points in the domain", system.points_in_domain().size() },
          { "peak memory [B]", peak_memory(run.communicator) } });
    if (settings.is_static)
      summary["wall time [s]"]
          = summary["wall time [s]"].get<double>() + context.seconds;
    else
      summary.update({ { "time [s]", double(context.state.step) * system.dt },
                       { "steps", context.state.step },
                       { "time step [s]", system.dt },
                       { "step ratio, smallest",
                         system.medium.c1 * system.dt / lengths.maxCoeff() },
                       { "step ratio, largest",
                         system.medium.c1 * system.dt / lengths.minCoeff() },
                       { "wall time per step [s]",
                         context.n_done > 0
                             ? context.march_seconds / double(context.n_done)
                             : 0. } });
    summarise_time(context.time_spent, seconds + context.seconds, summary);
    if (const PassivityReport *passivity = system.passivity.get())
      summary["passivity"] = { { "smallest eigenvalue [rho c2]",
                                 passivity->smallest_eigenvalue },
                               { "frequency [Hz]", passivity->frequency },
                               { "highest frequency [Hz]", passivity->nyquist },
                               { "frequencies", passivity->n_scanned } };
  }

  Problem::ClosingLines
  BoundaryProblem::closing_lines(const nlohmann::ordered_json &summary) const
  {
    return { settings.is_static ? "static solution"
                                : text_of(context.state.step, " steps"),
             text_of(1e-6 * summary["peak memory [B]"].get<double>(), " MB",
                     time_line(summary)) };
  }
} // namespace quoin
