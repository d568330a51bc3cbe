// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loading/constraint_checks.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/implicit/implicit_solver.h>
#include <quoin/implicit/reactions.h>
#include <quoin/implicit/rest_time.h>
#include <quoin/implicit/worst_place.h>
#include <quoin/motions/prescribed_motion.h>
#include <quoin/model/free_bodies.h>
#include <quoin/operators/archive.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Steps in which the drag of a jump whose loads rest has to fall to a
       share of it, or there is no equilibrium ahead, and most steps of a jump.
     */
    constexpr unsigned int drag_patience   = 500;
    constexpr double falling_drag          = 0.8;
    constexpr unsigned int most_drag_steps = 10000;
    /** Steps of a jump between trials without drag. */
    constexpr unsigned int trial_interval = 4;
    /** Displacement in a jump, by the model's size, that is a collapse. */
    constexpr double collapse_share = 0.05;
    /** Ratio of drag to applied force below which a jump may have ended. */
    constexpr double jump_ends = 1e-4;
    /** Way to the equilibrium behind a jump, by that of the jump, below which a
        search for the factor of safety takes it. */
    constexpr double near_share = 0.25;
    /** Path by that with a fifth of the drag, above which it is not the drag
        that limits it [-]. */
    constexpr double at_once_share = 0.9;

    /** Net force by the sum of all sizes from which it is no rounding. */
    constexpr double least_net_force = 1e-3;

    /** Duration of a static stage with constant loads [s]. */
    constexpr double resting_duration = 1.;

    void refuse_dynamic_loads(const std::vector<LoadParameters> &loads)
    {
      for (const LoadParameters &load : loads)
      {
        const std::string what
            = load.type == LoadType::viscous_boundary ? "a viscous boundary"
              : load.type == LoadType::free_field     ? "a free field"
                                                      : "";
        if (!what.empty())
          throw InputError("section 'Loads/" + load.name + "': 'Type' makes it "
                           + what
                           + ", which the implicit solver does not know. Take "
                             "'Solver = explicit', or hold that boundary.");
      }
    }
  } // namespace

  template <int dim>
  ImplicitSolver<dim>::ImplicitSolver(
      Model<dim> &model, const std::vector<LoadParameters> &loads,
      const ImplicitParameters &parameters,
      const std::vector<std::string> &joint_sets,
      std::unique_ptr<StaticFarField> far_field)
    : Solver<dim>((refuse_dynamic_loads(loads), model), loads, nullptr,
                  std::move(far_field)),
      parameters(parameters), own_steps(parameters),
      path_sets(joint_sets.size(), parameters.path_joints.empty()),
      set_names(joint_sets)
  {
    if (model.parameters().large_displacements)
      throw InputError(
          "section 'Contact': 'Displacements = large' asks for contacts that "
          "form and end, which the implicit solver does not follow. Take "
          "'small', or 'Solver = explicit'.");
    for (const std::string &name : parameters.path_joints)
    {
      const auto found = std::find(joint_sets.begin(), joint_sets.end(), name);
      if (found == joint_sets.end())
        throw InputError("section 'Implicit': 'Path joints' names '" + name
                         + "', which is no set of section 'Joints'.");
      path_sets[found - joint_sets.begin()] = true;
    }
  }

  template <int dim>
  void ImplicitSolver<dim>::prepare_stage(const State<dim> &state)
  {
    stage_start = state.load_start();
    check_no_free_bodies(model, acting.constraints, stage.name, state);
    refuse_shared_platens(model, acting.constraints, stage);
    if constexpr (dim == 2)
    {
      held_blocks = find_held_blocks(model, acting.constraints, stage);
      hold_absent_blocks(state);
    }
    double duration = stage.duration;
    bool rests      = false;
    if (stage.end != StageEnd::time)
    {
      duration = std::max({ rest_time(acting, stage, stage_start),
                            stage.minimum_duration, stage.release_duration });
      rests    = duration == 0.;
      if (rests)
        duration = resting_duration;
    }
    acting.release = Release(
        state, stage.releases_linearly.value_or(true),
        stage.release_duration >= 0. ? stage.release_duration : duration);
    rests = rests && !acting.release.changes()
            && !(all.water && all.water->acts()
                 && all.water->parameters().changes(stage_start, duration));
    own_steps.begin_stage(duration, rests, stage.safety.has_value());
    dof_map
        = std::make_unique<DofMap<dim>>(model, acting.constraints, held_blocks,
                                        state, acting.pattern != nullptr);
    equilibrium = std::make_unique<Equilibrium<dim>>(
        model, *dof_map, operators_with(acting.nodal), path_sets, stage_start,
        all.far.elastostatic_acts ? all.far.elastostatic : nullptr,
        acting.pattern.get(), all.beams.get());
    newton = std::make_unique<NewtonSolver<dim>>(
        model, all, acting, stage, parameters, own_steps, *dof_map,
        *equilibrium, time_shares, done);
  }

  template <int dim>
  typename Equilibrium<dim>::Operators ImplicitSolver<dim>::operators_with(
      const std::vector<const NodalLoad<dim> *> &loads) const
  {
    typename Equilibrium<dim>::Operators result{ &model.joints(),
                                                 &model.blocks() };
    if constexpr (dim == 2)
      if (!model.reinforcement().empty())
        result.push_back(&model.reinforcement());
    result.insert(result.end(), loads.begin(), loads.end());
    if constexpr (dim == 2)
      if (all.water && all.water->acts())
        result.push_back(all.water);
    result.push_back(&acting.release);
    return result;
  }

  template <int dim>
  void ImplicitSolver<dim>::hold_absent_blocks(const State<dim> &state)
  {
    const unsigned int first = model.nodes().blocks().n_deformable;
    for (unsigned int b = 0; b < held_blocks.size(); ++b)
      if (state.is_absent(model.nodes().blocks().parts[first + b].number))
        held_blocks[b] = true;
  }

  template <int dim>
  void ImplicitSolver<dim>::prepare(State<dim> &state) const
  {
    Solver<dim>::prepare(state);
    state.template add<ImplicitState>().dim = dim;
  }

  template <int dim>
  void ImplicitSolver<dim>::begin_stage(const StageParameters &new_stage,
                                        const StageParameters *previous,
                                        State<dim> &state)
  {
    this->activate(new_stage, previous, state);
    prepare(state);
    this->begin_growth(previous, 0., state);
    if constexpr (dim == 2)
    {
      if (all.water)
        all.water->begin_stage(stage.name, state);
      if (all.beams)
        all.beams->begin_stage(stage.name, state);
    }
    for (const auto &constraint : all.constraints)
      if (!all.acts_in(*constraint, stage))
        constraint->rest(state);
    for (MotionConstraint<dim> *constraint : acting.constraints)
    {
      constraint->set_mass(model.mass());
      constraint->begin_stage(state,
                              previous && all.acts_in(*constraint, *previous));
    }
    state.begin_clocks();
    state.load_rate                         = 1.;
    state.template get<ImplicitState>()     = ImplicitState();
    state.template get<ImplicitState>().dim = dim;
    this->begin_pattern(previous, state);
    prepare_stage(state);
    hold_what_is_out_of_balance(previous, state);
  }

  template <int dim>
  void ImplicitSolver<dim>::resume_stage(const StageParameters &resumed,
                                         const StageParameters *previous,
                                         State<dim> &state)
  {
    this->activate(resumed, nullptr, state);
    if constexpr (dim == 2)
    {
      if (all.water)
        all.water->resume_stage(state);
      if (all.beams)
        all.beams->resume_stage(state);
    }
    this->resume_growth(previous, state);
    for (MotionConstraint<dim> *constraint : acting.constraints)
      constraint->set_mass(model.mass());
    if (state.template get<ImplicitState>().jumps)
    {
      last_equilibrium = state;
      std::istringstream archived(
          state.template get<ImplicitState>().before_jump);
      boost::archive::binary_iarchive archive(archived);
      archive >> last_equilibrium;
    }
    state.template get<ImplicitState>().before_jump.clear();
    prepare_stage(state);
  }

  template <int dim>
  void ImplicitSolver<dim>::cut_liners(const std::vector<unsigned int> &blocks,
                                       State<dim> &state)
  {
    if constexpr (dim == 2)
    {
      if (!all.beams || !all.beams->cut(blocks, state))
        return;
      State<2> settled = state;
      AlignedArray<dealii::Tensor<1, 2>> unused(state.nodes.size(),
                                                dealii::Tensor<1, 2>());
      // Without an equilibrium the steps of the stage say so.
      if (all.beams
              ->settle(
                  { state.load_time, state.load_start() + state.load_time },
                  state, settled, unused.data(), nullptr)
              .empty())
        state = std::move(settled);
    }
  }

  template <int dim>
  void ImplicitSolver<dim>::save(State<dim> &state) const
  {
    Solver<dim>::save(state);
    if (state.template get<ImplicitState>().jumps)
    {
      std::ostringstream archived;
      boost::archive::binary_oarchive archive(archived);
      archive << last_equilibrium;
      state.template get<ImplicitState>().before_jump = archived.str();
    }
  }

  template <int dim>
  void ImplicitSolver<dim>::refuse_net_force(const State<dim> &state)
  {
    const auto &constraints = acting.constraints;
    const auto holds        = [&](const unsigned int d)
    {
      return std::any_of(constraints.begin(), constraints.end(),
                         [d](const MotionConstraint<dim> *each)
                         {
                           return each->traits().is_rigid_body()
                                  || (each->traits().kind
                                          == MotionKind::prescribed
                                      && each->traits().holds[d]);
                         });
    };
    if (!all.far.elastostatic_acts || all.beams || acting.pattern
        || (holds(0) && holds(1)))
      return;
    // As the stage would end if nothing moved.
    Configuration<dim> configuration
        = configuration_of(dof_map->bodies(), state);
    configuration.load_time = own_steps.duration();
    configuration.released  = 1.;
    Balance<dim> balance;
    equilibrium->find_forces(
        state, configuration,
        std::vector<std::uint8_t>(model.joints().n_points(), 0), balance);
    std::vector<double> sums(dim + 1, 0.);
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
    {
      for (unsigned int d = 0; d < dim; ++d)
        sums[d] += balance.force[i][d];
      sums[dim] += balance.force[i].norm();
    }
    dealii::Utilities::MPI::sum(sums, communicator, sums);
    for (unsigned int d = 0; d < dim; ++d)
      if (!holds(d) && std::abs(sums[d]) > least_net_force * sums[dim]
          && std::abs(sums[d]) > 10. * parameters.force_ratio * balance.applied)
        throw InputError(
            "section 'Stages/" + stage.name
            + "': what acts on the blocks "
              "in this stage has the net force "
            + number_text(sums[d]) + " N along " + (d == 0 ? "x" : "y")
            + ", which nothing takes: in the plane the static stiffness of the "
              "rock beyond, 'boundary elements', resists no translation, so "
              "that there is no equilibrium. An excavation under gravity has "
              "the weight of what it takes away. Hold the base of the model by "
              "a 'prescribed motion' in this stage, or balance the force.");
  }

  template <int dim>
  void ImplicitSolver<dim>::hold_what_is_out_of_balance(
      const StageParameters *previous, State<dim> &state)
  {
    ImplicitState &now = state.template get<ImplicitState>();
    own_steps.begin_loads(now);
    if constexpr (dim == 2)
      if (all.far.elastostatic_acts
          && !state.template get<StaticFarFieldState>().active)
      {
        // It holds the forces that its boundary carried until now, without
        // loads that begin here.
        std::vector<const NodalLoad<dim> *> before;
        for (const NodalLoad<dim> *load : acting.nodal)
          if (previous && names_load(*previous, load->name()))
            before.push_back(load);
        Equilibrium<dim> without(
            model, *dof_map, operators_with(previous ? before : acting.nodal),
            path_sets, stage_start, nullptr);
        Balance<dim> carried;
        without.find_forces(
            state, configuration_of(dof_map->bodies(), state),
            std::vector<std::uint8_t>(model.joints().n_points(), 0), carried);
        all.far.elastostatic->hold(carried.force.data(), state);
      }
    if constexpr (dim == 2)
      refuse_net_force(state);
    newton->find_forces(state);
    const Balance<dim> &balance = newton->current_balance();
    if (balance.ratio() <= parameters.force_ratio)
      return;
    own_steps.begin_release(now);
    const unsigned int n_owned = model.nodes().n_owned();
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        now.held.push_back(dof_map->is_free(i, d) ? -balance.force[i][d] : 0.);
    auto forces = body_forces(dof_map->bodies(), balance.force, communicator);
    for (unsigned int b = 0; b < forces.size(); ++b)
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        forces[b][d] = dof_map->bodies()[b].given[d]
                           ? 0.
                           : -forces[b][d] - balance.drives[b][d];
    keep_values(dof_map->bodies(), forces, model.rigid_blocks().n_blocks(),
                now.held_platens, now.held_blocks);
  }

  template <int dim>
  void ImplicitSolver<dim>::step(State<dim> &state)
  {
    const Balance<dim> &balance = newton->current_balance();
    attempt                     = { state.step, 0 };
    if (!state.template get<ImplicitState>().jumps)
      last_equilibrium = state;
    Configuration<dim> configuration;
    double refused = std::numeric_limits<double>::infinity();
    double drag    = refused; // by the applied forces
    for (;; ++attempt.number)
    {
      ImplicitState &now      = state.template get<ImplicitState>();
      const StepTarget target = own_steps.target(now, state.load_time);
      equilibrium->set_drag(now.jumps ? 1. / now.drag_step : 0.);
      const bool converged
          = newton->solve(state, target, attempt, configuration);
      const double error = newton->prediction_error();
      if (converged && target.path > 0.
          && configuration.load_time > own_steps.duration())
      {
        // The end of the stage is near: load control to reach it exactly.
        now.follows_path = false;
        now.step
            = (own_steps.duration() - state.load_time) / own_steps.duration();
        continue;
      }
      // Also in a jump joints must not yield too far in one step. A load step
      // may find an equilibrium far away, where blocks have slid until their
      // tilt holds them: it is none of the path that the loads follow.
      const double most
          = now.jumps ? own_steps.most_jump_path(now)
                      : collapse_share * model.nodes().table().diagonal();
      if (converged)
      {
        const double path = std::abs(balance.path);
        // The factor of a pattern whose loads no longer move what is controlled
        // may grow until blocks give way elsewhere.
        const double went = acting.pattern && !now.jumps
                                ? largest_move(state.nodes, configuration.nodes)
                                : 0.;
        const double last = drag;
        drag              = balance.dragged / balance.applied;
        if (own_steps.slows_loads(target, drag, last, state.load_time, now))
          continue;
        // Soft joints slip far once they lose strength, whatever the drag.
        if (std::max(path, went) <= most
            || (stage.safety && now.jumps && path > at_once_share * refused))
          break;
        refused = path;
      }
      if (own_steps.is_too_long(state.load_time, target, error))
      {
        own_steps.shorten(target, error, state.load_time, now);
        continue;
      }
      ++done.n_cuts;
      if (!own_steps.cut(equilibrium->measures_path(), state.load_time, now))
        give_up(state);
    }
    const State<dim> before = state;
    newton->remember_motion(configuration, state);
    commit(configuration, state);
    if (state.template get<ImplicitState>().jumps)
      go_on_jumping(before, state);
    else
      own_steps.adapt(before, newton->n_iterations(),
                      newton->prediction_error(), balance.path, state);
  }

  template <int dim>
  void ImplicitSolver<dim>::go_on_jumping(const State<dim> &before,
                                          State<dim> &state)
  {
    const Balance<dim> &balance = newton->current_balance();
    ImplicitState &now          = state.template get<ImplicitState>();
    now.jump_loss += state.energy.damping - before.energy.damping;
    ++now.n_drag;
    now.drag_time += now.drag_step;
    now.drag_path += std::abs(balance.path);
    // A search for the factor of safety judges by itself how far it goes.
    if (now.n_drag >= most_drag_steps || !comes_to_rest(before, now)
        || (!stage.safety
            && largest_move(last_equilibrium.nodes, state.nodes)
                   > collapse_share * model.nodes().table().diagonal()))
      give_up(state);
    own_steps.adapt_jump(newton->n_iterations(), balance.path, now);
    // Trials without drag cost as much as steps: at first, then at intervals.
    if (state.load_time < now.jump_time
        || balance.dragged > jump_ends * balance.applied
        || (now.n_drag > short_jump && now.n_drag % trial_interval != 0))
      return;
    // Near an equilibrium: test whether it is one without drag.
    equilibrium->set_drag(0.);
    Configuration<dim> configuration;
    const StepTarget target{ now.jump_time, now.jump_released, 0. };
    if (!newton->solve(state, target, attempt, configuration))
      return;
    // An equilibrium far ahead is none that the model comes to; whether it
    // would is what a search for the factor of safety asks: it has to go there.
    const double near
        = stage.safety
              ? near_share * largest_move(last_equilibrium.nodes, state.nodes)
              : collapse_share * model.nodes().table().diagonal();
    if (largest_move(state.nodes, configuration.nodes) > near)
      return;
    commit(configuration, state);
    own_steps.end_jump(last_equilibrium.template get<ImplicitState>(), now);
    done.jumps.push_back(
        { now.jump_time, now.n_drag,
          dealii::Utilities::MPI::sum(now.jump_loss, communicator) });
  }

  template <int dim>
  bool ImplicitSolver<dim>::comes_to_rest(const State<dim> &before,
                                          ImplicitState &now) const
  {
    const Balance<dim> &balance = newton->current_balance();
    const double drag           = balance.dragged / balance.applied;
    if (now.n_drag == 1 || before.load_time < now.jump_time)
    {
      now.watched_from = now.n_drag;
      now.watched_drag = drag;
    }
    if (now.n_drag < now.watched_from + drag_patience)
      return true;
    const bool falls = drag <= falling_drag * now.watched_drag;
    now.watched_from = now.n_drag;
    now.watched_drag = drag;
    return falls;
  }

  template <int dim>
  double ImplicitSolver<dim>::largest_move(
      const AlignedArray<NodeRecord<dim>> &from,
      const AlignedArray<NodeRecord<dim>> &to) const
  {
    double moved = 0.;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        moved = std::max(moved, std::abs(to[i].u[d] - from[i].u[d]));
    return dealii::Utilities::MPI::max(moved, communicator);
  }

  template <int dim>
  void ImplicitSolver<dim>::give_up(State<dim> &state)
  {
    const double tried = std::abs(state.template get<ImplicitState>().step);
    const bool jumped  = state.template get<ImplicitState>().jumps;
    state              = last_equilibrium;
    fail(state, tried, jumped);
  }

  template <int dim>
  void ImplicitSolver<dim>::move_against_drag(State<dim> &state)
  {
    last_equilibrium = state;
    own_steps.begin_jump(state.load_time, state.template get<ImplicitState>());
  }

  template <int dim>
  void ImplicitSolver<dim>::commit(const Configuration<dim> &configuration,
                                   State<dim> &state)
  {
    const Balance<dim> &balance = newton->current_balance();
    EnergyAccounts done         = balance.state.energy;
    book_work(model, *dof_map,
              all.far.elastostatic_acts ? all.far.elastostatic : nullptr, state,
              newton->start_balance(), configuration, balance, done);
    state.energy += done;
    const double went = std::abs(configuration.load_time - state.load_time);

    write_configuration(dof_map->bodies(), configuration, state);
    state.copy_slices(balance.state);
    if constexpr (dim == 2)
    {
      if (all.water)
        all.water->commit(state);
      RigidBlockStage rigid;
      rigid.held = held_blocks;
      model.rigid_blocks().follow_nodes(rigid, state);
    }
    state.unbalanced_ratio = balance.ratio();
    if (ImplicitState &now = state.template get<ImplicitState>();
        now.released == 1.)
      for (auto *held : { &now.held, &now.held_platens, &now.held_blocks })
        held->clear();
    ++state.step;
    ++state.stage_step;
    // Time also advances while the load time decreases.
    state.time += went;
    if (state.load_time == own_steps.duration()
        && state.template get<ImplicitState>().path_length == 0.
        && balance.path == 0.)
      state.time = state.stage_start + own_steps.duration();
    if (all.far.elastostatic_acts)
      state.template get<StaticFarFieldState>().stored
          = balance.far_field_energy;
    EnergyAccounts stored;
    for (const ForceOperator<dim> *each : operators_with(acting.nodal))
      each->add_stored_energy(state, stored);
    if constexpr (dim == 2)
      if (all.beams)
        all.beams->add_stored_energy(state, stored);
    this->find_energies(state, stored);
  }

  template <int dim>
  bool ImplicitSolver<dim>::has_balance() const
  {
    const bool is_here = newton && !newton->current_balance().force.empty();
    return dealii::Utilities::MPI::max(unsigned(is_here), communicator) > 0;
  }

  template <int dim>
  Resultant<dim> ImplicitSolver<dim>::resultant(const std::string &load) const
  {
    if (!has_balance())
      return {};
    for (const MotionConstraint<dim> *constraint : acting.constraints)
      if (constraint->name() == load)
        return reaction(model, *dof_map, all.far.elastostatic,
                        newton->current_balance(), *constraint);
    return {};
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ImplicitSolver<dim>::node_forces(const MotionConstraint<dim> &platen) const
  {
    std::vector<dealii::Tensor<1, dim>> result;
    const bool is_known = has_balance();
    for (const unsigned int node : platen.nodes())
      result.push_back(is_known ? -newton->current_balance().force[node]
                                : dealii::Tensor<1, dim>());
    return result;
  }

  template <int dim>
  void ImplicitSolver<dim>::fail(const State<dim> &state, const double tried,
                                 const bool jumped) const
  {
    const Balance<dim> &balance = newton->current_balance();
    const bool is_beam          = !balance.failed_beam.empty();
    const auto &properties      = model.properties();
    const bool joints_fail
        = model.nodes().faces().n_global_joints > 0
          && std::any_of(properties.joints.begin(), properties.joints.end(),
                         [](const JointSetParameters &set)
                         { return can_fail(set.law); });
    const bool blocks_fail
        = std::any_of(properties.materials.begin(), properties.materials.end(),
                      [](const MaterialParameters &material)
                      { return material.strength.has_value(); });
    const bool is_elastic = !is_beam && !joints_fail && !blocks_fail;
    const std::string why
        = is_beam
              ? "The beam '" + balance.failed_beam
                    + "' found none with the blocks beside it. It may have "
                      "reached its limit load, by plastic hinges or by "
                      "buckling"
              : "Forces are out of balance most "
                    + worst_place(model, *dof_map, balance, set_names)
                    + (is_elastic ? ". Neither joints nor blocks can fail: "
                                    "check supports, stiffnesses and loads"
                                  : ". The model may have reached its limit "
                                    "load there");
    std::ostringstream message;
    message << "no equilibrium was found beyond "
            << (state.template get<ImplicitState>().released < 1.
                    ? number_text(
                          100. * state.template get<ImplicitState>().released)
                          + " % of what was out of balance at the start"
                    : "the load time " + number_text(state.load_time) + " of "
                          + number_text(own_steps.duration()) + " s")
            << (jumped ? ", and the model kept moving when it was released "
                         "against a viscous drag, after steps were reduced to "
                       : ", although steps were reduced to ")
            << number_text(tried) << " of the stage. " << why
            << (parameters.path == PathFollowing::never && !is_elastic
                    ? ": 'Path following = automatic' in section 'Implicit' "
                      "could follow it down"
                    : "")
            << "; otherwise lower 'First step'"
            << (is_elastic
                    ? " or raise 'Maximum iterations'"
                    : ", raise 'Maximum iterations', or look at the "
                      "strengths "
                          + std::string(is_beam       ? "and loads of that beam"
                                        : joints_fail ? "of those joints"
                                                      : "of that block")
                          + ". Compare with 'Solver = explicit' before "
                            "you take it for the limit load")
            << ". The last equilibrium is kept.";
    throw ModelFailure(message.str());
  }

  template class ImplicitSolver<2>;
  template class ImplicitSolver<3>;
} // namespace quoin
