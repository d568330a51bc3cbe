// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/wall_clock.h>
#include <quoin/farfield/boundary_report.h>
#include <quoin/problems/problem.h>
#include <quoin/block_problem/stage_steps.h>
#include <quoin/results/measurements.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /**
     * Safety factor on the time step where the phase of modes must advance by
     * less than about 60 degrees a step. With local damping fast modes would
     * otherwise keep ringing and hold up slow ones. With joints that open and
     * close, whose kink falls between two steps, stiff joints that chatter
     * would otherwise create energy.
     */
    constexpr double cautious_share = 0.5;

    /** Largest number of steps of a stage. */
    constexpr double most_steps = 1e12;
    /** Largest number of steps of boundary elements, and of steps of blocks in
        each. */
    constexpr double most_boundary_steps = 1e9;

    template <int dim>
    bool joints_may_fail(const Model<dim> &model)
    {
      return std::any_of(model.joints().laws().begin(),
                         model.joints().laws().end(), can_fail)
             || model.parameters().large_displacements;
    }
  } // namespace

  template <int dim>
  StageSteps<dim>::StageSteps(BlockSystem<dim> &system, Log &log)
    : system(system), parameters(system.parameters), log(log)
  {
  }

  template <int dim>
  void StageSteps<dim>::choose(const StageParameters &stage)
  {
    const double critical = system.explicit_solver->critical_step().length;
    double dt             = parameters.time_step;
    if (dt > critical)
      throw InputError(text_of(
          parameters.file, ", section 'Time stepping': 'Time step = ", dt,
          "' is above the critical time step ", critical, " s of stage '",
          stage.name, "'. Give a smaller one, or 0 for an automatic one."));
    if (dt == 0. && !std::isfinite(critical))
      throw InputError(
          parameters.file
          + ", section 'Time stepping': 'Time step = 0' asks for the critical "
            "time step times the safety factor, but in stage '"
          + stage.name
          + "' rigid blocks move freely, without joints, and any step is "
            "stable. Give one.");
    if (dt == 0.)
      dt = critical
           * (stage.damping == DampingType::local
                      || joints_may_fail(*system.model)
                  ? std::min(parameters.share_of_critical_step, cautious_share)
                  : parameters.share_of_critical_step);
    steps_of_stage = 0;
    if constexpr (dim == 2)
      if (system.solver->loads().far.elastodynamic_acts)
        dt = choose_far_field_step(stage, dt);
    if (stage.end == StageEnd::time
        && !system.solver->loads().far.elastodynamic_acts)
    {
      // The stage ends at a step, not near one.
      steps_of_stage = std::uint64_t(count_steps(
          stage.duration, dt, most_steps,
          text_of(parameters.file, ", section 'Stages/", stage.name,
                  "': 'Duration = ", stage.duration, "'"),
          "Give a larger 'Time step' in section 'Time stepping', or a shorter "
          "duration."));
      dt             = stage.duration / double(steps_of_stage);
    }
    system.explicit_solver->set_time_step(dt);
  }

  template <>
  double StageSteps<2>::choose_far_field_step(const StageParameters &stage,
                                              const double dt)
  {
    FarField &far = *system.solver->loads().far.elastodynamic;
    const BoundaryElementParameters &settings = parameters.boundary;
    const std::string section
        = parameters.file + ", section 'Boundary elements': ";
    const std::string cure
        = "Give a larger 'Time step', there and in section 'Time stepping', or "
          "shorter stages.";
    const auto steps = [&](const double duration, const double step)
    {
      return count_steps(duration, step, most_boundary_steps,
                         text_of(section, "a stage of ", duration, " s"), cure);
    };
    double step      = far.time_step();
    const bool first = step == 0.;
    if (first)
    {
      step = settings.wanted_time_step(far.domain().boundary);
      if (stage.end == StageEnd::time)
        step = stage.duration / steps(stage.duration, step);
    }
    const double n_substeps
        = count_steps(step, dt, most_boundary_steps,
                      text_of(section, "a time step of ", step, " s"), cure);
    double n_steps = 0.;
    for (const StageParameters &s : parameters.stages)
      if (s.end == StageEnd::time)
        n_steps += steps(s.duration, step);
    naming(parameters.file,
           [&]()
           {
             if (first && !settings.waves.empty())
               make_waves(step);
             const auto begin = WallClock::now();
             far.set_time_step(
                 step, static_cast<unsigned int>(n_substeps),
                 static_cast<unsigned long>(std::min(n_steps, 1e7)));
             if (first)
               log.message(
                   "boundary elements: ", seconds_text(seconds_since(begin)),
                   " for their influence matrices");
           });
    if (first)
      report_far_field();
    // Whole steps of the boundary elements: up to one more than asked for.
    if (stage.end == StageEnd::time)
      steps_of_stage = std::uint64_t(steps(stage.duration, step) * n_substeps);
    return step / n_substeps;
  }

  template <>
  void StageSteps<2>::make_waves(const double step)
  {
    FarFields &fields = system.solver->loads().far;
    FarField &far     = *fields.elastodynamic;
    double duration   = 0.;
    for (const StageParameters &stage : parameters.stages)
      if (stage.end == StageEnd::time && names_load(stage, far.name()))
        duration += stage.duration + step;
    waves = std::make_unique<IncidentWaves>(
        parameters.boundary, far.domain().medium, far.domain().boundary,
        std::vector<dealii::Point<2>>(), duration, step);
    far.set_incident_field([this](const double time)
                           { return waves->displacements(time); },
                           [this](const double begin, const double end)
                           { return waves->tractions(begin, end); });
    fields.incident_energy
        = waves->energy(far.domain().medium, far.domain().interface, duration,
                        step)
          * system.model->parameters().thickness;
    log.messages(waves->reports());
  }

  template <>
  void StageSteps<2>::report_far_field()
  {
    const FarField &far    = *system.solver->loads().far.elastodynamic;
    const Boundary &domain = far.domain().boundary;
    const auto lengths     = domain.lengths();
    log.message("boundary elements: ", domain.n_elements(), ", ",
                far.domain().interface.size(), " of them along blocks, ",
                range_text(lengths.minCoeff(), lengths.maxCoeff()),
                " m long; S waves of up to ",
                far.domain().medium.c2 / (8. * lengths.maxCoeff()),
                " Hz have eight of the longest to a wavelength");
    log.message("boundary elements: time step ", far.time_step(), " s, ",
                far.n_substeps(), " steps of the blocks, ",
                step_ratio_text(domain, far.domain().medium, far.time_step()));
    const auto begin     = WallClock::now();
    const auto passivity = passivity_of(
        far.influence_kernel(), far.boundary_history(), domain,
        far.domain().medium, far.domain().formulation, far.time_step(),
        parameters.boundary.n_frequencies, system.communicator);
    if (passivity)
      log.message(passivity->advice(), " The scan took ",
                  seconds_text(seconds_since(begin)), ".");
  }

  template class StageSteps<2>;
  template class StageSteps<3>;
} // namespace quoin
