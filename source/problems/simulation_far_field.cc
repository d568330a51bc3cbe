// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/boundary_report.h>
#include <quoin/results/field_output.h>
#include <quoin/problems/simulation.h>
#include <quoin/problems/step_count.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/results/collective.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /**
     * By what went through the model. No domain that was at rest gives energy;
     * the first moments of a pulse, too short for the elements, may look so by
     * a tenth. Modes that grow soon owe all they have to the boundary elements.
     */
    constexpr double largest_created_share = 0.5;
    /** No run of so many comes to its end; nor does one with so many steps of
        blocks in each. */
    constexpr double most_boundary_steps = 1e9;
  } // namespace

  double Simulation::choose_far_field_step(const StageParameters &stage,
                                           const double dt)
  {
    FarField &far                             = *solver->far_field();
    const BoundaryElementParameters &settings = parameters.boundary;
    const std::string section
        = parameters.file + ", section 'Boundary elements': ";
    const std::string cure
        = "Give a larger 'Time step', there and in section 'Time stepping', or "
          "shorter stages.";
    const auto steps = [&](const double duration, const double step)
    {
      return count_steps(duration, step, most_boundary_steps,
                         section + "a stage of " + number_text(duration) + " s",
                         cure);
    };
    double step      = far.time_step();
    const bool first = step == 0.;
    if (first)
    {
      step = wanted_time_step(settings, far.domain().boundary,
                              far.domain().medium);
      if (stage.end == StageEnd::time)
        step = stage.duration / steps(stage.duration, step);
    }
    const double n_substeps = count_steps(
        step, dt, most_boundary_steps,
        section + "a time step of " + number_text(step) + " s", cure);
    double n_steps = 0.;
    for (const StageParameters &s : parameters.stages)
      if (s.end == StageEnd::time)
        n_steps += steps(s.duration, step);
    try
    {
      if (first && !settings.waves.empty())
        make_waves(step);
      far.set_time_step(step, static_cast<unsigned int>(n_substeps),
                        static_cast<unsigned long>(std::min(n_steps, 1e7)));
    }
    catch (const InputError &error)
    {
      throw InputError(parameters.file + ", " + error.what());
    }
    if (first)
      report_far_field();
    // Whole steps of the boundary elements: up to one more than asked for.
    if (stage.end == StageEnd::time)
      steps_of_stage = std::uint64_t(steps(stage.duration, step) * n_substeps);
    return step / n_substeps;
  }

  void Simulation::make_waves(const double step)
  {
    FarField &far   = *solver->far_field();
    double duration = 0.;
    for (const StageParameters &stage : parameters.stages)
      if (stage.end == StageEnd::time && names_load(stage, far.name()))
        duration += stage.duration + step;
    waves = std::make_unique<IncidentWaves>(
        parameters.boundary, far.domain().medium, far.domain().boundary,
        std::vector<Eigen::Vector2d>(), duration, step);
    far.set_incident_field([this](const double time)
                           { return waves->displacements(time); },
                           [this](const double begin, const double end)
                           { return waves->tractions(begin, end); });
    for (const std::string &text : waves->reports())
      log.message(text);
  }

  void Simulation::report_far_field()
  {
    const FarField &far    = *solver->far_field();
    const Boundary &domain = far.domain().boundary;
    const auto lengths     = domain.lengths();
    log.message(
        "boundary elements: " + std::to_string(domain.n_elements()) + ", "
        + std::to_string(far.domain().interface.size())
        + " of them along blocks, from " + number_text(lengths.minCoeff())
        + " to " + number_text(lengths.maxCoeff()) + " m; S waves of up to "
        + number_text(far.domain().medium.c2 / (8. * lengths.maxCoeff()))
        + " Hz have eight of them");
    log.message(
        "boundary elements: time step " + number_text(far.time_step()) + " s, "
        + std::to_string(far.n_substeps()) + " block steps, "
        + step_ratio_text(domain, far.domain().medium, far.time_step()));
    passivity = passivity_of(far.influence_kernel(), far.boundary_history(),
                             domain, far.domain().medium,
                             far.domain().formulation, far.time_step(),
                             parameters.boundary.n_frequencies, communicator);
    if (passivity)
      log.message(passivity->advice());
  }

  void Simulation::write_far_field_row()
  {
    const FarField *far = solver->far_field();
    if (!far)
      return;
    const FarField::Ledger ledger = far->ledger(record.state);
    const double taken            = ledger.radiated + ledger.given;
    record.largest_throughput
        = std::max({ record.largest_throughput, std::abs(ledger.radiated),
                     std::abs(ledger.given), solver->energies().throughput() });
    if (taken < -largest_created_share * record.largest_throughput)
      throw RunError("the boundary elements have created energy, "
                     + number_text(-taken) + " J of "
                     + number_text(record.largest_throughput)
                     + " J that went through the model: their discrete "
                       "impedance is not passive. Change 'Step ratio' or "
                       "'Formulation' in section 'Boundary elements' until the "
                       "passivity scan finds nothing, or damp the blocks.");
    record.far_field_table.add_row(
        { record.state.time, double(record.state.far_field.n_steps),
          ledger.radiated, ledger.substeps, ledger.incident, ledger.given,
          ledger.mismatch });
  }

  void Simulation::write_boundary()
  {
    const FarField &far = *solver->far_field();
    if (!solver->far_field_acts() || !record.state.far_field.active)
      return;
    const BoundaryState fields = boundary_state(far, record.state);
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                              record.boundary_output.write(
                                  record.state.time,
                                  boundary_fields(boundary_geometry, fields));
                          });
  }
} // namespace quoin
