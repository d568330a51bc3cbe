// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/far_field_setup.h>
#include <quoin/problems/input_advice.h>
#include <quoin/problems/model_summary.h>
#include <quoin/problems/open_log.h>
#include <quoin/problems/simulation.h>
#include <quoin/problems/step_count.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/wall_clock.h>
#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/results/collective.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    constexpr std::uint64_t balance_interval = ExplicitSolver::balance_interval;

    /**
     * Largest share of the critical step where modes must turn by less than
     * about 60 degrees a step. Local damping needs it for its sense of
     * direction: beyond, fast modes keep ringing and hold up the slow ones.
     * Joints that open and close need it, because the kink in their law falls
     * between two steps: beyond, stiff joints that chatter create energy.
     */
    constexpr double cautious_share = 0.5;

    /** No run of so many steps comes to its end. */
    constexpr double most_steps = 1e12;
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
              {},
              {},
              BlockOutput(parameters.output_directory, communicator),
              JointOutput(parameters.output_directory, communicator),
              JointOutput(parameters.output_directory, communicator,
                          "contacts"),
              BoundaryOutput(parameters.output_directory, MPI_COMM_SELF) },
      checkpoint_clock(parameters.checkpoint_interval, communicator)
  {
  }

  void Simulation::run()
  {
    make_model();
    report_model();
    if (options.check)
      return report_costs();
    open_outputs();
    if (record.state.stage == parameters.stages.size())
    {
      log.message("the run had finished: nothing is left to do");
      return;
    }
    checkpoint_clock.restart();
    if (options.resume)
      resume();
    for (unsigned int i = record.state.stage; i < parameters.stages.size(); ++i)
      if (parameters.stages[i].safety)
        run_safety_stage(i);
      else if (implicit_solver)
        run_implicit_stage(i);
      else
        run_stage(i);
  }

  void Simulation::make_model()
  {
    const MeshData as_read
        = parameters.generated.geometry.empty()
              ? read_gmsh(parameters.mesh_file, communicator,
                          parameters.triangles)
              : mesh_gmsh_geometry(parameters.generated.geometry,
                                   parameters.generated.name == "wall"
                                       ? "section Wall"
                                       : "section Rock",
                                   communicator, parameters.triangles);
    run_identity = run_fingerprint(parameters, as_read);
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
      model = std::make_unique<Model>(mesh, rank_of_block, parameters.model,
                                      communicator);
      construction = std::make_unique<Construction>(*model, parameters.stages);
      make_solver(as_read);
      histories = std::make_unique<Histories>(
          parameters.histories, *model, *solver, boundary_geometry,
          parameters.boundary, construction->absent_in_the_end());
      record.state = model->initial_state();
      if (parameters.initial_motion.is_given)
        set_initial_motion();
    }
    catch (const InputError &error)
    {
      throw InputError(parameters.file + ", " + error.what());
    }
  }

  void Simulation::make_solver(const MeshData &as_read)
  {
    auto far = make_far_field(parameters, as_read, *model, boundary_geometry);
    auto static_far = make_static_far_field(parameters, *model, far.get());
    if (parameters.is_implicit)
    {
      std::vector<std::string> joint_sets;
      for (const JointSetParameters &set : parameters.model.joints)
        joint_sets.push_back(set.name);
      auto made = std::make_unique<ImplicitSolver>(
          *model, parameters.loads, parameters.implicit, joint_sets,
          std::move(static_far));
      implicit_solver = made.get();
      solver          = std::move(made);
      return;
    }
    auto made = std::make_unique<ExplicitSolver>(
        *model, parameters.loads, parameters.stages, std::move(far),
        std::move(static_far));
    explicit_solver = made.get();
    solver          = std::move(made);
  }

  void Simulation::set_initial_motion()
  {
    all_or_none<InputError>(communicator, [&]()
                            { parameters.initial_motion.apply(record.state); });
    explicit_solver->account_for_initial_motion(record.state);
  }

  void Simulation::report_model()
  {
    log.message(parameters.title.empty() ? parameters.file : parameters.title);
    report_mesh();
    if (const StaticFarField *far = solver->static_far_field())
      log.message("static boundary elements: their forces' matrix was "
                  "symmetric to "
                  + number_text(far->asymmetry()) + " of its largest entry");

    for (const JointSetParameters &set : parameters.model.joints)
    {
      const std::string warning = law_warning(set.law);
      if (!warning.empty())
        log.warning("section 'Joints/" + set.name + "': " + warning);
    }
    report_initial_joints();
    if (options.check)
      report_parts();
    advise(model_advice(parameters, *model));
    if (implicit_solver)
      return report_implicit_model();

    // Each stage's step is found without starting it.
    State<2> state     = record.state;
    bool time_is_known = true; // until a stage ends when it has settled
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      begin_stage(i, state, time_is_known);
      choose_time_step(stage);
      if (options.check)
        log.message(stage_line(stage, false));
      log.message(
          "stage " + stage.name + ": time step "
          + number_text(explicit_solver->get_time_step()) + " s, "
          + number_text(100. * explicit_solver->get_time_step()
                        / explicit_solver->critical_time_step())
          + " % of the critical "
          + number_text(explicit_solver->critical_time_step()) + " s"
          + (stage.end == StageEnd::time
                 ? ", " + std::to_string(steps_of_stage)
                       + (stage.slows_loads() ? " steps or more" : " steps")
                 : "")
          + (explicit_solver->added_mass_share() > 0.
                 ? ", mass scaling adds "
                       + number_text(100. * explicit_solver->added_mass_share())
                       + " % of mass"
                 : ""));
      advise_about_stage(i, state);
      time_is_known &= stage.end == StageEnd::time && !stage.slows_loads();
      if (time_is_known)
        state.time += double(steps_of_stage) * explicit_solver->get_time_step();
    }
    construction->restart();
  }

  void Simulation::report_mesh()
  {
    // What touches without matching is in contact if displacements are large.
    if (parameters.model.contact.large_displacements)
      mesh_report.unmatched_length = 0.;
    if (!parameters.generated.report.empty())
      log.message(parameters.generated.report);
    log.message(mesh_report.to_text());
    const auto &rigid          = model->is_rigid();
    const unsigned int n_rigid = std::count(rigid.begin(), rigid.end(), true);
    if (n_rigid > 0)
      log.message(std::to_string(n_rigid) + " of the blocks "
                  + (n_rigid == 1 ? "is rigid" : "are rigid"));
    const unsigned int n_ranks
        = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks > mesh.n_blocks())
      log.warning("the model has " + std::to_string(mesh.n_blocks())
                  + (mesh.n_blocks() == 1 ? " block" : " blocks")
                  + " and the run " + std::to_string(n_ranks)
                  + " MPI ranks, to which whole blocks are dealt: some have "
                    "none. Fewer ranks would be as fast, but for boundary "
                    "elements, which all share.");
    if (mesh_report.unmatched_length > 0.)
      log.warning("outer edges lie on each other over "
                  + number_text(mesh_report.unmatched_length)
                  + " m without matching nodes, the first near ("
                  + number_text(mesh_report.unmatched_position[0]) + ", "
                  + number_text(mesh_report.unmatched_position[1])
                  + ") m: no joint is made there. Mesh both sides alike.");

    // A double has 16 digits.
    double farthest = 0.;
    for (unsigned int d = 0; d < 2; ++d)
      farthest = std::max({ farthest, std::abs(mesh_report.lower_left[d]),
                            std::abs(mesh_report.upper_right[d]) });
    if (mesh_report.shortest_edge < 1e-8 * farthest)
      log.warning("coordinates of up to " + number_text(farthest)
                  + " m leave few digits to edges of "
                  + number_text(mesh_report.shortest_edge)
                  + " m. Move the model nearer to the origin.");
    if (mesh_report.overlaps)
      log.warning("blocks overlap near ("
                  + number_text(mesh_report.overlap_position[0]) + ", "
                  + number_text(mesh_report.overlap_position[1])
                  + ") m, where both then have their mass and stiffness. Take "
                    "the surface out that is there twice, or cut it out of "
                    "the other.");
  }

  void Simulation::report_initial_joints()
  {
    if (parameters.model.initial_stresses.empty())
      return;
    const double n
        = model->joints().n_beyond_strength(record.state.joints, communicator);
    if (n > 0.)
      log.warning(number_text(n) + " of "
                  + std::to_string(2 * mesh.joint_faces.size())
                  + " joint points begin with tractions beyond their strength: "
                    "they yield in the first stage. Check the initial stress "
                    "and the strength of these joints.");
  }

  void Simulation::begin_stage(const unsigned int index, State<2> &state,
                               const bool time_is_known)
  {
    const StageParameters *previous = previous_stage(parameters.stages, index);
    try
    {
      construction->begin_stage(index, *solver, state);
      if (implicit_solver)
        implicit_solver->begin_stage(parameters.stages[index], previous, state);
      else
        explicit_solver->begin_stage(parameters.stages[index], previous, state);
      if (time_is_known)
        solver->check_start(state);
    }
    catch (const InputError &error)
    {
      const std::string what = parameters.file + ", " + error.what();
      // Wrong input is what is found before anything is computed.
      if (state.step > 0)
        throw RunError(what);
      throw InputError(what);
    }
  }

  void Simulation::resume()
  {
    const unsigned int index = record.state.stage;
    if (record.stage_begun)
      construction->resume_stage(index, record.state);
    else if (index > 0)
    {
      construction->resume_stage(index - 1, record.state);
      if (explicit_solver)
        explicit_solver->restore_masses(
            *previous_stage(parameters.stages, index), record.state);
    }
  }

  void Simulation::choose_time_step(const StageParameters &stage)
  {
    const double critical = explicit_solver->critical_time_step();
    double dt             = parameters.time_step;
    if (dt > critical)
      throw InputError(parameters.file
                       + ", section 'Time stepping': 'Time step = "
                       + number_text(dt) + "' is above the critical time step "
                       + number_text(critical) + " s of stage '" + stage.name
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
      steps_of_stage = std::uint64_t(count_steps(
          stage.duration, dt, most_steps,
          parameters.file + ", section 'Stages/" + stage.name
              + "': 'Duration = " + number_text(stage.duration) + "'",
          "Give a larger 'Time step' in section 'Time stepping', or a shorter "
          "duration."));
      dt             = stage.duration / double(steps_of_stage);
    }
    explicit_solver->set_time_step(dt);
  }

  void Simulation::run_stage(const unsigned int index)
  {
    const StageParameters &stage = parameters.stages[index];
    State<2> &state              = record.state;
    if (record.stage_begun)
      explicit_solver->resume_stage(stage, state);
    else
    {
      begin_stage(index, state);
      record.stage_begun = true;
    }
    choose_time_step(stage);
    state.far_field.history.clear();

    progress.start(progress_figures(stage));
    bool over = stage.end == StageEnd::time && time_is_over(stage);
    while (!over)
    {
      const auto start     = WallClock::now();
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
    end_stage(index);
  }

  void Simulation::end_stage(const unsigned int index)
  {
    solver->check_finite(record.state);
    solver->check_cells(record.state);
    warn_of_slip(parameters.stages[index]);
    record.stage_begun = false;
    record.state.stage = index + 1;
    write_fields();
    // Before the checkpoint, after which there is nothing to resume.
    write_summary(record.state.stage == parameters.stages.size());
    save_checkpoint();
  }

  void Simulation::warn_of_slip(const StageParameters &stage)
  {
    /** Half of the blocks' edges is left on each other. */
    constexpr double most = 0.5;
    if (model->large_displacements())
      return;
    const double share = solver->largest_slip_share(record.state);
    if (share > most)
      log.warning("stage " + stage.name + ": joints have slipped by up to "
                  + number_text(100. * share)
                  + " % of the edges that touch, but small displacements leave "
                    "blocks where they are: areas and neighbours no longer "
                    "hold. Take 'Displacements = large' in section 'Contact'.");
  }

  bool Simulation::take_step(const StageParameters &stage)
  {
    State<2> &state    = record.state;
    const double dt    = explicit_solver->get_time_step();
    const bool balance = state.stage_step % balance_interval == 0;
    if (field_control.is_due(state.time, dt))
      write_fields();

    // A stage's last step has a row of its own; a static stage may find only
    // afterwards that this was it.
    const bool row_is_due = history_control.is_due(state.time, dt);
    const bool may_be_last
        = stage.slows_loads() ? loads_are_over(
              stage, state.load_time + (1. + 1e-6) * state.load_rate * dt)
          : stage.end == StageEnd::time ? state.stage_step + 1 == steps_of_stage
                                        : balance;
    ExplicitSolver::Requests requests;
    requests.energies = row_is_due || may_be_last;
    requests.balance  = balance || (row_is_due && histories->need_balance());
    if (requests.energies)
      histories->before_step(state);
    try
    {
      explicit_solver->step(state, requests);
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
      write_energies(row.front());
      record.history_table.add_row(row);
      write_far_field_row();
    }
    if (balance || over)
      check_tables();
    return over;
  }

  void Simulation::report_blocks_outside()
  {
    for (const BlockOutside &block : explicit_solver->take_blocks_outside())
      log.warning("block " + std::to_string(block.block) + ", at ("
                  + number_text(block.position[0]) + ", "
                  + number_text(block.position[1])
                  + ") m, has left the box at time " + number_text(block.time)
                  + " s"
                  + (block.removed ? " and is deleted"
                     : parameters.model.contact.outside
                             == ContactParameters::Outside::remove
                         ? "; it stays in the model, because a load moves it "
                           "or joints tie it to a block that stays"
                         : ""));
  }

  bool Simulation::loads_are_over(const StageParameters &stage,
                                  const double load_time) const
  {
    return load_time >= (1. - 1e-12) * stage.duration;
  }

  bool Simulation::time_is_over(const StageParameters &stage) const
  {
    return stage.slows_loads() ? loads_are_over(stage, record.state.load_time)
                               : record.state.stage_step >= steps_of_stage;
  }

  bool Simulation::stage_is_over(const StageParameters &stage,
                                 const bool balance)
  {
    if (stage.end == StageEnd::time)
    {
      if (time_is_over(stage))
        return true;
      if (stage.slows_loads() && record.state.stage_step >= stage.maximum_steps)
        throw RunError(
            "stage '" + stage.name + "' has not come to its end within "
            + std::to_string(stage.maximum_steps) + " steps: its loads are at "
            + number_text(record.state.load_time) + " of "
            + number_text(stage.duration) + " s and go on at the rate "
            + number_text(record.state.load_rate)
            + ". Raise 'Kinetic energy limit' or 'Maximum steps', or damp "
              "more.");
      return false;
    }
    if (has_settled(stage, balance))
      return true;
    if (record.state.stage_step >= stage.maximum_steps)
      throw RunError("stage '" + stage.name + "' has not settled within "
                     + std::to_string(stage.maximum_steps)
                     + " steps: the unbalanced ratio is "
                     + number_text(record.state.unbalanced_ratio)
                     + " instead of " + number_text(stage.static_ratio)
                     + ". The model may have no equilibrium under these "
                       "loads; otherwise raise 'Maximum steps' or damp more.");
    return false;
  }

  bool Simulation::has_settled(const StageParameters &stage,
                               const bool balance) const
  {
    const State<2> &state = record.state;
    return balance && state.time - state.stage_start >= stage.minimum_duration
           && state.stage_step > balance_interval
           && state.unbalanced_ratio <= stage.static_ratio
           && !solver->loads_change(
               state, balance_interval * explicit_solver->get_time_step());
  }

  double Simulation::energy_residual() const
  {
    const Energies &energies = solver->energies();
    const double scale       = energies.throughput();
    return scale > 0. ? energies.residual() / scale : 0.;
  }

  ProgressFigures
  Simulation::progress_figures(const StageParameters &stage) const
  {
    ProgressFigures figures;
    figures.stage = stage.name;
    figures.time  = record.state.time;
    figures.step  = record.state.step;
    if (implicit_solver)
      figures.fraction
          = record.state.implicit.released < 1.
                ? 0.
                : record.state.load_time / implicit_solver->duration();
    else
      figures.fraction = stage.end == StageEnd::time
                             ? record.state.load_time / stage.duration
                             : -1.;
    if (explicit_solver)
      figures.share_of_critical = explicit_solver->get_time_step()
                                  / explicit_solver->critical_time_step();
    figures.unbalanced_ratio = record.state.unbalanced_ratio;
    figures.energy_residual  = energy_residual();
    return figures;
  }
} // namespace quoin
