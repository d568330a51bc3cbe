// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/bandwidth.h>
#include <quoin/application/far_field_setup.h>
#include <quoin/application/field_output.h>
#include <quoin/application/simulation.h>
#include <quoin/base/exceptions.h>
#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/collective.h>
#include <quoin/output/json_file.h>
#include <quoin/tdbem/passivity.h>
#include <quoin/tdbem/tangential_stress.h>

#include <nlohmann/json.hpp>

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

    /** Steps between looks at unbalanced force and at NaN. */
    constexpr std::uint64_t balance_interval = 100;
    /** Steps between looks at the clock for a checkpoint. */
    constexpr std::uint64_t clock_interval = 256;

    /**
     * Largest share of the critical step where modes must turn by less than
     * about 60 degrees a step. Local damping needs it for its sense of
     * direction: beyond, fast modes keep ringing and hold up the slow ones.
     * Joints that open and close need it, because the kink in their law falls
     * between two steps: beyond, stiff joints that chatter create energy.
     */
    constexpr double cautious_share = 0.5;

    /**
     * By what went through the model. Nothing can radiate less than nothing
     * from a domain that was at rest; what rounds the discrete account is far
     * below.
     */
    constexpr double largest_created_share = 0.05;

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
  } // namespace

  Simulation::Simulation(const Parameters &parameters,
                         const RunOptions &options, const MPI_Comm communicator)
    : parameters(parameters), options(options), communicator(communicator),
      is_first_rank(dealii::Utilities::MPI::this_mpi_process(communicator)
                    == 0),
      output(parameters.output_directory), log(is_first_rank, options.quiet),
      progress(log), history_control(parameters.history_interval),
      field_control(parameters.field_interval > 0. ? parameters.field_interval
                                                   : -1.),
      record{ {},
              0,
              0,
              BlockOutput(parameters.output_directory, communicator),
              JointOutput(parameters.output_directory, communicator),
              JointOutput(parameters.output_directory, communicator,
                          "contacts"),
              BoundaryOutput(parameters.output_directory, MPI_COMM_SELF) }
  {
  }

  void Simulation::run()
  {
    make_model();
    report_model();
    if (options.check)
      return;
    open_outputs();
    if (record.state.stage == parameters.stages.size())
    {
      log.message("the run had finished: nothing is left to do");
      return;
    }
    last_checkpoint = Clock::now();
    for (unsigned int i = record.state.stage; i < parameters.stages.size(); ++i)
      run_stage(i);
    write_summary(true);
  }

  void Simulation::make_model()
  {
    const MeshData as_read = read_gmsh(parameters.mesh_file, communicator);
    split_into_blocks(as_read, parameters.split, mesh);
    mesh_report = make_mesh_report(mesh);

    // Whole blocks to ranks: blocks share no nodes, only joints cross ranks.
    auto rank_of_block = partition_blocks(
        mesh, dealii::Utilities::MPI::n_mpi_processes(communicator));
    try
    {
      renumber_blocks(
          mesh,
          order_by_part(rank_of_block,
                        find_rigid_blocks(mesh, parameters.model.materials)));
      std::sort(rank_of_block.begin(), rank_of_block.end());
      model    = std::make_unique<Model>(mesh, rank_of_block, parameters.model,
                                      communicator);
      auto far = make_far_field(parameters, as_read, *model, boundary_geometry);
      auto static_far = make_static_far_field(parameters, *model, far.get());
      solver          = std::make_unique<ExplicitSolver>(
          *model, parameters.loads, parameters.stages, std::move(far),
          std::move(static_far));
      histories
          = std::make_unique<Histories>(parameters.histories, *model, *solver,
                                        boundary_geometry, parameters.boundary);
      record.state = model->initial_state();
      if (parameters.initial_motion.is_given)
        set_initial_motion();
    }
    catch (const InputError &error)
    {
      throw InputError(parameters.file + ", " + error.what());
    }
  }

  void Simulation::set_initial_motion()
  {
    all_or_none<InputError>(communicator, [&]()
                            { parameters.initial_motion.apply(record.state); });
    solver->account_for_initial_motion(record.state);
  }

  void Simulation::report_model()
  {
    log.message(parameters.title.empty() ? parameters.file : parameters.title);
    // What touches without matching is in contact if displacements are large.
    if (parameters.model.contact.large_displacements)
      mesh_report.unmatched_length = 0.;
    log.message(mesh_report.to_text());
    const auto &rigid          = model->is_rigid();
    const unsigned int n_rigid = std::count(rigid.begin(), rigid.end(), true);
    if (n_rigid > 0)
      log.message(std::to_string(n_rigid) + " of the blocks "
                  + (n_rigid == 1 ? "is rigid" : "are rigid"));
    if (mesh_report.unmatched_length > 0.)
      log.warning("outer edges lie on each other over "
                  + number(mesh_report.unmatched_length)
                  + " m without matching nodes, the first near ("
                  + number(mesh_report.unmatched_position[0]) + ", "
                  + number(mesh_report.unmatched_position[1])
                  + ") m: no joint is made there. Mesh both sides alike.");

    if (const StaticFarField *far = solver->static_far_field())
      log.message("static boundary elements: their forces' matrix was "
                  "symmetric to "
                  + number(far->asymmetry()) + " of its largest entry");

    // Each stage's step is found without starting it.
    State state = record.state;
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      try
      {
        solver->begin_stage(stage, i == 0 ? nullptr : &parameters.stages[i - 1],
                            state);
        if (i == 0)
          solver->check_start(state);
      }
      catch (const InputError &error)
      {
        throw InputError(parameters.file + ", " + error.what());
      }
      choose_time_step(stage);
      log.message("stage " + stage.name + ": time step "
                  + number(solver->get_time_step()) + " s, "
                  + number(100. * solver->get_time_step()
                           / solver->critical_time_step())
                  + " % of the critical " + number(solver->critical_time_step())
                  + " s"
                  + (stage.end == StageEnd::time
                         ? ", " + std::to_string(steps_of_stage) + " steps"
                         : "")
                  + (solver->added_mass_share() > 0.
                         ? ", mass scaling adds "
                               + number(100. * solver->added_mass_share())
                               + " % of mass"
                         : ""));
    }
  }

  void Simulation::open_outputs()
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
    energy_table  = std::make_unique<CsvTable>(
        output + "/energies.csv",
        std::vector<std::string>{ "time [s]", "kinetic [J]", "strain [J]",
                                   "joint [J]", "friction [J]", "fracture [J]",
                                   "damping [J]", "viscous [J]", "contact [J]",
                                   "radiated [J]", "far field [J]",
                                   "external [J]", "residual [J]" });
    if (solver->far_field())
      far_field_table = std::make_unique<CsvTable>(
          output + "/far_field.csv",
          std::vector<std::string>{ "time [s]", "steps [-]", "radiated [J]",
                                    "substeps [J]", "incident [J]", "given [J]",
                                    "mismatch [-]" });
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
          {
            history_table->resume(record.histories_bytes);
            energy_table->resume(record.energies_bytes);
            if (far_field_table)
              far_field_table->resume(record.far_field_bytes);
          }
          else
          {
            std::filesystem::remove_all(output + "/checkpoint");
            history_table->start();
            energy_table->start();
            if (far_field_table)
            {
              far_field_table->start();
              record.boundary_output.start();
            }
          }
          std::ofstream used(output + "/used_parameters.prm");
          used << parameters.effective;
          used.close();
          if (!used)
            throw RunError("'" + output
                           + "/used_parameters.prm' cannot be written. Is the "
                             "disk full?");
        });
    record.block_output.start();
    record.joint_output.start();
    if (solver->contacts())
      record.contact_output.start();
  }

  void Simulation::choose_time_step(const StageParameters &stage)
  {
    const double critical = solver->critical_time_step();
    double dt             = parameters.time_step;
    if (dt > critical)
      throw InputError(parameters.file
                       + ", section 'Time stepping': 'Time step = " + number(dt)
                       + "' is above the critical time step " + number(critical)
                       + " s of stage '" + stage.name
                       + "'. Give a smaller one, or 0 for an automatic one.");
    if (dt == 0. && !std::isfinite(critical))
      throw InputError(parameters.file
                       + ", section 'Time stepping': 'Time step = 0' asks for "
                         "a share of the critical step, but in stage '"
                       + stage.name
                       + "' rigid blocks move freely, without joints, and any "
                         "step is stable. Give one.");
    if (dt == 0.)
      dt = critical
           * (stage.damping == DampingType::local || model->joints().can_fail()
                      || model->large_displacements()
                  ? std::min(parameters.share_of_critical_step, cautious_share)
                  : parameters.share_of_critical_step);
    steps_of_stage = 0;
    if (solver->far_field_acts())
      dt = choose_far_field_step(stage, dt);
    else if (stage.end == StageEnd::time)
    {
      // The stage ends at a step, not near one.
      steps_of_stage = std::ceil(stage.duration / dt * (1. - 1e-12));
      dt             = stage.duration / steps_of_stage;
    }
    solver->set_time_step(dt);
  }

  double Simulation::choose_far_field_step(const StageParameters &stage,
                                           const double dt)
  {
    FarField &far                             = *solver->far_field();
    const BoundaryElementParameters &settings = parameters.boundary;
    const auto steps = [](const double duration, const double step)
    { return std::max(1., std::ceil(duration / step * (1. - 1e-12))); };
    double step      = far.time_step();
    const bool first = step == 0.;
    if (first)
    {
      step = settings.time_step > 0.
                 ? settings.time_step
                 : settings.step_ratio
                       * far.domain().boundary.lengths().minCoeff()
                       / far.domain().medium.c1;
      if (stage.end == StageEnd::time)
        step = stage.duration / steps(stage.duration, step);
    }
    const double n_substeps = steps(step, dt);
    double n_steps          = 0.;
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
      if (stage.end == StageEnd::time
          && std::find(stage.loads.begin(), stage.loads.end(), far.name())
                 != stage.loads.end())
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
    const double low
        = far.domain().medium.c1 * far.time_step() / lengths.maxCoeff();
    const double high
        = far.domain().medium.c1 * far.time_step() / lengths.minCoeff();
    log.message("boundary elements: " + std::to_string(domain.n_elements())
                + ", " + std::to_string(far.domain().interface.size())
                + " of them along blocks, from " + number(lengths.minCoeff())
                + " to " + number(lengths.maxCoeff()) + " m; S waves of up to "
                + number(far.domain().medium.c2 / (8. * lengths.maxCoeff()))
                + " Hz have eight of them");
    log.message("boundary elements: time step " + number(far.time_step())
                + " s, " + std::to_string(far.n_substeps())
                + " block steps, c1 dt / L "
                + (high - low < 1e-6 * high
                       ? number(high)
                       : "from " + number(low) + " to " + number(high)));
    if (parameters.boundary.n_frequencies == 0)
      return;
    const unsigned int n       = parameters.boundary.n_frequencies;
    const ZTransform transform = make_transform(
        far.lag_kernel(), far.boundary_history(), domain, far.domain().medium,
        far.domain().formulation, communicator);
    passivity = std::make_unique<PassivityReport>(
        scan_passivity(transform, domain, far.domain().medium, far.time_step(),
                       n, 1. - 0.5 / double(n)));
    log.message(passivity->advice());
  }

  void Simulation::check_start() const
  {
    try
    {
      solver->check_start(record.state);
    }
    catch (const InputError &error)
    {
      throw InputError(parameters.file + ", " + error.what());
    }
  }

  void Simulation::run_stage(const unsigned int index)
  {
    const StageParameters &stage = parameters.stages[index];
    State &state                 = record.state;
    if (record.stage_begun)
      solver->resume_stage(stage, state);
    else
    {
      solver->begin_stage(
          stage, index == 0 ? nullptr : &parameters.stages[index - 1], state);
      check_start();
      record.stage_begun = true;
    }
    choose_time_step(stage);
    state.far_field.history.clear();

    progress.start(progress_figures(stage));
    bool over
        = stage.end == StageEnd::time && state.stage_step >= steps_of_stage;
    while (!over)
    {
      const auto start     = Clock::now();
      over                 = take_step(stage);
      const double seconds = seconds_since(start);
      record.wall_time += seconds;
      seconds_done += seconds;
      ++steps_done;
      if (progress.due())
        progress.update(progress_figures(stage));
      checkpoint_if_due();
    }
    progress.finish(progress_figures(stage));

    solver->check_finite(state);
    solver->check_cells(state);
    record.stage_begun = false;
    state.stage        = index + 1;
    write_fields();
    write_summary(false);
    save_checkpoint();
  }

  bool Simulation::take_step(const StageParameters &stage)
  {
    State &state       = record.state;
    const double dt    = solver->get_time_step();
    const bool balance = state.stage_step % balance_interval == 0;
    if (field_control.is_due(state.time, dt))
      write_fields();

    // A stage's last step has a row of its own; a static stage may find only
    // afterwards that this was it.
    const bool row_is_due  = history_control.is_due(state.time, dt);
    const bool may_be_last = stage.end == StageEnd::time
                                 ? state.stage_step + 1 == steps_of_stage
                                 : balance;
    ExplicitSolver::Requests requests;
    requests.energies = row_is_due || may_be_last;
    requests.balance  = balance || (row_is_due && histories->need_balance());
    if (requests.energies)
      histories->before_step(state);
    try
    {
      solver->step(state, requests);
    }
    catch (const RunError &error)
    {
      throw RunError("stage '" + stage.name + "': " + error.what());
    }
    report_blocks_outside();
    const bool over = stage_is_over(stage, balance);
    if (row_is_due || over)
    {
      solver->check_finite(state);
      const auto row = histories->after_step(state);
      write_energies();
      if (is_first_rank)
        history_table->add_row(row);
      write_far_field_row();
    }
    return over;
  }

  void Simulation::report_blocks_outside()
  {
    for (const BlockOutside &block : solver->take_blocks_outside())
      log.warning("block " + std::to_string(block.block) + ", at ("
                  + number(block.position[0]) + ", " + number(block.position[1])
                  + ") m, has left the box at time " + number(block.time) + " s"
                  + (block.removed ? " and is deleted"
                     : parameters.model.contact.outside
                             == ContactParameters::Outside::remove
                         ? "; it stays in the model, because a load moves it "
                           "or joints tie it to a block that stays"
                         : ""));
  }

  bool Simulation::stage_is_over(const StageParameters &stage,
                                 const bool balance)
  {
    if (stage.end == StageEnd::time)
      return record.state.stage_step >= steps_of_stage;
    if (balance
        && !solver->loads_have_changed(
            record.state, balance_interval * solver->get_time_step())
        && record.state.time - record.state.stage_start
               >= stage.minimum_duration
        && record.state.stage_step > balance_interval
        && record.state.unbalanced_ratio <= stage.static_ratio)
      return true;
    if (record.state.stage_step >= stage.maximum_steps)
      throw RunError("stage '" + stage.name + "' has not settled within "
                     + std::to_string(stage.maximum_steps)
                     + " steps: the unbalanced ratio is "
                     + number(record.state.unbalanced_ratio) + " instead of "
                     + number(stage.static_ratio)
                     + ". The model may have no equilibrium under these "
                       "loads; otherwise raise 'Maximum steps' or damp more.");
    return false;
  }

  double Simulation::energy_residual() const
  {
    const Energies &energies = solver->energies();
    const double scale       = energies.throughput();
    return scale > 0. ? energies.residual() / scale : 0.;
  }

  void Simulation::write_energies()
  {
    const Energies &energies       = solver->energies();
    const EnergyAccounts &accounts = energies.accounts;
    record.largest_residual
        = std::max(record.largest_residual, std::abs(energies.residual()));
    if (is_first_rank)
      energy_table->add_row(
          { record.state.time - solver->get_time_step(), energies.kinetic,
            energies.strain, energies.joint, accounts.friction,
            accounts.fracture, accounts.damping, accounts.viscous,
            accounts.contact, accounts.radiated, energies.far_field,
            accounts.external, energies.residual() });
  }

  void Simulation::write_fields()
  {
    const State &state = record.state;
    if (state.time == record.fields_time)
      return;
    record.fields_time = state.time;
    record.block_output.write(state.time, block_fields(*model, state));
    // Histories are those of the step before.
    State now = state;
    solver->update_histories(now);
    record.joint_output.write(state.time, joint_fields(*model, now));
    if (solver->contacts())
      record.contact_output.write(state.time,
                                  contact_fields(*solver->contacts(), now));
    if (solver->far_field())
      write_boundary();
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                            {
                              history_table->flush();
                              energy_table->flush();
                              if (far_field_table)
                                far_field_table->flush();
                            }
                          });
  }

  void Simulation::write_far_field_row()
  {
    const FarField *far = solver->far_field();
    if (!far)
      return;
    const FarField::Ledger ledger = far->ledger(record.state);
    const double throughput       = solver->energies().throughput();
    const double taken            = ledger.radiated + ledger.given;
    if (taken < -largest_created_share * throughput)
      throw RunError("the boundary elements have created energy, "
                     + number(-taken) + " J of " + number(throughput)
                     + " J that went through the model: their discrete "
                       "impedance is not passive. Change 'Step ratio' or "
                       "'Formulation' in section 'Boundary elements' until the "
                       "passivity scan finds nothing, or damp the blocks.");
    if (!is_first_rank)
      return;
    far_field_table->add_row(
        { record.state.time, double(record.state.far_field.n_steps),
          ledger.radiated, ledger.substeps, ledger.incident, ledger.given,
          ledger.mismatch });
  }

  void Simulation::write_boundary()
  {
    const FarField &far = *solver->far_field();
    if (!solver->far_field_acts() || !record.state.far_field.active)
      return;
    const Boundary &domain  = boundary_geometry.boundary;
    const Eigen::VectorXd u = far.displacement(record.state),
                          v = far.velocity(record.state),
                          p = far.traction(record.state);
    const Eigen::VectorXd hoop
        = TangentialStress(domain, far.domain().medium)(u, p);
    all_or_none<RunError>(
        communicator,
        [&]()
        {
          if (!is_first_rank)
            return;
          BoundaryFields fields;
          for (unsigned int e = 0; e < domain.n_elements(); ++e)
          {
            const BoundaryElement &element = domain.elements[e];
            fields.a.push_back({ { element.a.x(), element.a.y() } });
            fields.b.push_back({ { element.b.x(), element.b.y() } });
            fields.boundary.push_back(std::int32_t(boundary_geometry.owner[e]));
            fields.displacement.push_back({ { u[2 * e], u[2 * e + 1] } });
            fields.velocity.push_back({ { v[2 * e], v[2 * e + 1] } });
            fields.traction.push_back({ { p[2 * e], p[2 * e + 1] } });
            fields.hoop_stress.push_back(hoop[e]);
          }
          record.boundary_output.write(record.state.time, fields);
        });
  }

  void Simulation::checkpoint_if_due()
  {
    if (parameters.checkpoint_interval == 0.
        || record.state.stage_step % clock_interval != 0)
      return;
    // The first rank's clock counts for all.
    const bool due = dealii::Utilities::MPI::broadcast(
        communicator,
        seconds_since(last_checkpoint) > parameters.checkpoint_interval);
    if (due)
      save_checkpoint();
  }

  void Simulation::save_checkpoint()
  {
    solver->check_finite(record.state);
    solver->check_cells(record.state);
    solver->save(record.state);
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                            {
                              history_table->sync();
                              energy_table->sync();
                              if (far_field_table)
                              {
                                far_field_table->sync();
                                record.far_field_bytes
                                    = far_field_table->size();
                              }
                              record.histories_bytes = history_table->size();
                              record.energies_bytes  = energy_table->size();
                            }
                          });
    CheckpointInfo info;
    info.step       = record.state.step;
    info.time       = record.state.time;
    info.version    = QUOIN_VERSION;
    info.parameters = fingerprint(parameters.effective);
    quoin::save_checkpoint(output, communicator, info, record);
    record.state.far_field.history.clear();
    last_checkpoint = Clock::now();
  }

  ProgressFigures
  Simulation::progress_figures(const StageParameters &stage) const
  {
    ProgressFigures figures;
    figures.stage    = stage.name;
    figures.time     = record.state.time;
    figures.step     = record.state.step;
    figures.fraction = stage.end == StageEnd::time
                           ? double(record.state.stage_step) / steps_of_stage
                           : -1.;
    figures.share_of_critical
        = solver->get_time_step() / solver->critical_time_step();
    figures.unbalanced_ratio = record.state.unbalanced_ratio;
    figures.energy_residual  = energy_residual();
    return figures;
  }

  void Simulation::write_summary(const bool finished)
  {
    const double updates
        = seconds_done > 0.
              ? double(mesh.n_cells()) * double(steps_done) / seconds_done
              : 0.;
    nlohmann::json summary
        = { { "title", parameters.title },
            { "version", QUOIN_VERSION },
            { "finished", finished },
            { "ranks", dealii::Utilities::MPI::n_mpi_processes(communicator) },
            { "blocks", mesh.n_blocks() },
            { "rigid blocks", std::count(model->is_rigid().begin(),
                                         model->is_rigid().end(), true) },
            { "cells", mesh.n_cells() },
            { "nodes", mesh.n_vertices() },
            { "joint faces", mesh.joint_faces.size() },
            { "joint length [m]", mesh_report.total_joint_length },
            { "shortest edge [m]", mesh_report.shortest_edge },
            { "smallest angle [deg]", mesh_report.smallest_angle },
            { "time [s]", record.state.time },
            { "steps", record.state.step },
            { "time step [s]", solver->get_time_step() },
            { "critical time step [s]", solver->critical_time_step() },
            { "added mass share", solver->added_mass_share() },
            { "wall time [s]", record.wall_time },
            { "element updates per second", updates },
            { "unbalanced ratio", record.state.unbalanced_ratio },
            { "energy throughput [J]", solver->energies().throughput() },
            { "energy residual [J]", solver->energies().residual() },
            { "largest energy residual [J]", record.largest_residual },
            { "energy residual share", energy_residual() } };
    if (parameters.model.contact.has_box)
    {
      const auto &marks         = record.state.contacts.outside;
      summary["blocks deleted"] = std::count(marks.begin(), marks.end(),
                                             BlockContacts::removed_from_model);
      summary["blocks outside the box"]
          = std::count(marks.begin(), marks.end(), BlockContacts::left_box);
    }
    if (const BlockContacts *contacts = solver->contacts())
    {
      const double sums[3]
          = { contacts->n_touching(record.state.contacts),
              double(contacts->n_updates()), contacts->search_seconds() };
      std::array<double, 3> all;
      MPI_Allreduce(sums, all.data(), 3, MPI_DOUBLE, MPI_SUM, communicator);
      summary["contacts"] = all[0];
      summary["contact updates per second"]
          = seconds_done > 0. ? all[1] / seconds_done : 0.;
      summary["contact searches"] = record.state.contacts.n_searches;
      // Ranks search together: the mean of their times counts.
      summary["contact search share"]
          = seconds_done > 0.
                ? all[2] / dealii::Utilities::MPI::n_mpi_processes(communicator)
                      / seconds_done
                : 0.;
    }
    if (finished && parameters.measure_bandwidth)
    {
      const double measured
          = dealii::Utilities::MPI::sum(memory_bandwidth(), communicator);
      const double used = step_bytes(mesh.n_vertices(), mesh.n_cells())
                          * double(steps_done) / seconds_done;
      summary["memory bandwidth [B/s]"]    = measured;
      summary["share of memory bandwidth"] = used / measured;
    }
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (is_first_rank)
                              write_json(output + "/summary.json", summary);
                          });
    if (!finished)
      return;
    log.message("finished: " + std::to_string(record.state.step) + " steps in "
                + duration_text(record.wall_time) + ", " + number(updates / 1e6)
                + " million element updates a second, energy residual "
                + number(energy_residual()) + " of what went through");
    if (solver->contacts())
      log.message(
          "contacts: "
          + number(summary["contact updates per second"].get<double>() / 1e6)
          + " million updates a second, "
          + std::to_string(record.state.contacts.n_searches)
          + " searches that took "
          + number(100. * summary["contact search share"].get<double>())
          + " % of the time");
  }
} // namespace quoin
