// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// ImplicitSolver at the start of a stage and the end of a step;
// implicit_solver.cc has its steps.

#include <quoin/operators/archive.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/model/free_bodies.h>
#include <quoin/implicit/implicit_solver.h>
#include <quoin/loading/constraint_checks.h>
#include <quoin/loads/prescribed_motion.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Duration of a static stage with constant loads [s]. */
    constexpr double resting_duration = 1.;

    /** A joint is named unless a force inside a block is so much larger. */
    constexpr double joint_preference = 10.;

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

  ImplicitSolver::ImplicitSolver(Model<2> &model,
                                 const std::vector<LoadParameters> &loads,
                                 const ImplicitParameters &parameters,
                                 const std::vector<std::string> &joint_sets,
                                 std::unique_ptr<StaticFarField> far_field)
    : Solver((refuse_dynamic_loads(loads), model), loads, nullptr,
             std::move(far_field)),
      parameters(parameters),
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

  double ImplicitSolver::rest_time() const
  {
    const auto values
        = [&](const double t) { return acting.values(stage_start, t); };
    constexpr double earliest = 1e-9; // [s]
    const auto last           = values(late_time);
    if (values(1.7 * late_time) != last)
      throw InputError("section 'Stages/" + stage.name
                       + "': 'End = static ratio', but its loads never become "
                         "constant. Take 'End = time' and a 'Duration', or "
                         "functions of time that become constant.");
    for (const MotionConstraint<2> *constraint : acting.constraints)
    {
      if (constraint->parts())
        for (const LoadComponent &part : *constraint->parts())
          if (part.quantity == LoadQuantity::velocity
              && part.value({ late_time, stage_start + late_time }) != 0.)
            throw InputError("section 'Loads/" + constraint->name()
                             + "': a velocity that does not become zero "
                               "prevents equilibrium in the stage '"
                             + stage.name
                             + "', whose 'End' is 'static ratio'. Take 'End = "
                               "time' and a 'Duration'.");
    }
    double rests = late_time, moves = 0.;
    for (double t = late_time; t > earliest; t *= 0.9)
      if (values(t) == last)
        rests = t;
      else
      {
        moves = t;
        break;
      }
    if (moves == 0. && values(0.) == last)
      rests = 0.;
    while (rests > earliest && rests - moves > 1e-9 * rests)
    {
      const double middle                      = 0.5 * (rests + moves);
      (values(middle) == last ? rests : moves) = middle;
    }
    // Loads that jump at the start of the stage are constant from then on.
    return rests > earliest ? rests : 0.;
  }

  void ImplicitSolver::prepare_stage(const State<2> &state)
  {
    stage_start = state.stage_start;
    check_no_free_bodies(model, acting.constraints, stage.name, state);
    refuse_shared_platens(model, acting.constraints, stage);
    held_blocks = find_held_blocks(model, acting.constraints, stage);
    hold_absent_blocks(state);
    rests = false;
    if (stage.end == StageEnd::time)
      stage_duration = stage.duration;
    else
    {
      stage_duration = std::max(
          { rest_time(), stage.minimum_duration, stage.release_duration });
      rests = stage_duration == 0.;
      if (rests)
        stage_duration = resting_duration;
    }
    acting.release = Release(
        state, stage,
        stage.release_duration >= 0. ? stage.release_duration : stage_duration);
    rests = rests && !acting.release.changes()
            && !(all.water && all.water->changes(stage_start, stage_duration));
    dof_map = std::make_unique<DofMap>(model, acting.constraints, held_blocks,
                                       state, acting.pattern != nullptr);
    equilibrium = std::make_unique<Equilibrium>(
        model, *dof_map, operators_with(acting.nodal), path_sets, stage_start,
        all.far.elastostatic_acts ? all.far.elastostatic : nullptr,
        acting.pattern.get(), all.beams.get());
    // Multigrid gives no factor.
    linear_solver = std::make_unique<LinearSolver>(
        acting.pattern ? LinearSolverType::direct : parameters.linear_solver,
        model, *dof_map);
    residual.reinit(dof_map->owned(), communicator);
    slopes.by_advance = slopes.path_by_dof = correction = advanced = residual;
    broken.assign(model.joints().n_points(), 0);
  }

  Equilibrium::Operators ImplicitSolver::operators_with(
      const std::vector<const NodalLoad<2> *> &loads) const
  {
    Equilibrium::Operators result{ &model.joints(), &model.blocks() };
    if (!model.reinforcement().empty())
      result.push_back(&model.reinforcement());
    result.insert(result.end(), loads.begin(), loads.end());
    if (all.water && all.water->acts())
      result.push_back(all.water);
    result.push_back(&acting.release);
    return result;
  }

  void ImplicitSolver::hold_absent_blocks(const State<2> &state)
  {
    const unsigned int first = model.nodes().blocks().n_deformable;
    for (unsigned int b = 0; b < held_blocks.size(); ++b)
      if (state.is_absent(model.nodes().blocks().parts[first + b].number))
        held_blocks[b] = true;
  }

  void ImplicitSolver::prepare(State<2> &state) const
  {
    Solver::prepare(state);
    state.add<ImplicitState>();
  }

  void ImplicitSolver::begin_stage(const StageParameters &new_stage,
                                   const StageParameters *previous,
                                   State<2> &state)
  {
    activate(new_stage, state);
    ramp_gravity(previous, 0.);
    prepare(state);
    if (all.water)
      all.water->begin_stage(stage.name, state);
    if (all.beams)
      all.beams->begin_stage(stage.name, state);
    for (const auto &constraint : all.constraints)
      if (!all.acts_in(*constraint, stage))
        constraint->rest(state);
    for (MotionConstraint<2> *constraint : acting.constraints)
    {
      constraint->set_mass(model.mass());
      constraint->begin_stage(state,
                              previous && all.acts_in(*constraint, *previous));
    }
    state.stage_start          = state.time;
    state.stage_step           = 0;
    state.load_time            = 0.;
    state.load_rate            = 1.;
    state.get<ImplicitState>() = ImplicitState();
    begin_pattern(previous, state);
    prepare_stage(state);
    hold_what_is_out_of_balance(previous, state);
  }

  void ImplicitSolver::resume_stage(const StageParameters &resumed,
                                    const StageParameters *previous,
                                    State<2> &state)
  {
    activate(resumed, state);
    if (all.water)
      all.water->resume_stage(state);
    ramp_gravity(previous, 0.);
    for (MotionConstraint<2> *constraint : acting.constraints)
      constraint->set_mass(model.mass());
    if (state.get<ImplicitState>().jumps)
    {
      last_equilibrium = state;
      std::istringstream archived(state.get<ImplicitState>().before_jump);
      boost::archive::binary_iarchive archive(archived);
      archive >> last_equilibrium;
    }
    state.get<ImplicitState>().before_jump.clear();
    prepare_stage(state);
  }

  void ImplicitSolver::save(State<2> &state) const
  {
    Solver::save(state);
    if (state.get<ImplicitState>().jumps)
    {
      std::ostringstream archived;
      boost::archive::binary_oarchive archive(archived);
      archive << last_equilibrium;
      state.get<ImplicitState>().before_jump = archived.str();
    }
  }

  void
  ImplicitSolver::hold_what_is_out_of_balance(const StageParameters *previous,
                                              State<2> &state)
  {
    ImplicitState &now = state.get<ImplicitState>();
    now.released       = 1.;
    now.step           = first_load_step();
    if (all.far.elastostatic_acts && !state.get<StaticFarFieldState>().active)
    {
      // It holds the forces that its boundary carried until now, without loads
      // that begin here.
      std::vector<const NodalLoad<2> *> before;
      for (const NodalLoad<2> *load : acting.nodal)
        if (previous && names_load(*previous, load->name()))
          before.push_back(load);
      Equilibrium without(model, *dof_map,
                          operators_with(previous ? before : acting.nodal),
                          path_sets, stage_start, nullptr);
      without.find_forces(state, configuration_of(dof_map->bodies(), state),
                          broken, balance);
      all.far.elastostatic->hold(balance.force.data(), state);
    }
    equilibrium->find_forces(state, configuration_of(dof_map->bodies(), state),
                             broken, balance);
    if (balance.ratio() <= parameters.force_ratio)
      return;
    now.released               = 0.;
    now.step                   = parameters.first_step;
    const unsigned int n_owned = model.nodes().n_owned();
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        now.held.push_back(dof_map->is_free(i, d) ? -balance.force[i][d] : 0.);
    const auto forces
        = body_forces(dof_map->bodies(), balance.force, communicator);
    now.held_blocks.resize(3 * std::size_t(model.rigid_blocks().n_blocks()));
    for (unsigned int b = 0; b < forces.size(); ++b)
      for (unsigned int d = 0; d < 3; ++d)
      {
        const RigidBody &body = dof_map->bodies()[b];
        const double held
            = body.given[d] ? 0. : -forces[b][d] - balance.drives[b][d];
        if (body.platen)
          now.held_platens.push_back(held);
        else
          now.held_blocks[3 * body.rigid_block + d] = held;
      }
  }

  void ImplicitSolver::commit(const Configuration &configuration,
                              State<2> &state)
  {
    EnergyAccounts done = balance.state.energy;
    book_work(state, configuration, done);
    state.energy += done;
    const double went = std::abs(configuration.load_time - state.load_time);

    write_configuration(dof_map->bodies(), configuration, state);
    state.copy_slices(balance.state);
    if (all.water)
      all.water->commit(state);
    RigidBlockStage rigid;
    rigid.held = held_blocks;
    model.rigid_blocks().follow_nodes(rigid, state);
    state.unbalanced_ratio = balance.ratio();
    if (ImplicitState &now = state.get<ImplicitState>(); now.released == 1.)
      for (auto *held : { &now.held, &now.held_platens, &now.held_blocks })
        held->clear();
    ++state.step;
    ++state.stage_step;
    // Time also advances while the load time decreases.
    state.time += went;
    if (state.load_time == stage_duration
        && state.get<ImplicitState>().path_length == 0. && balance.path == 0.)
      state.time = state.stage_start + stage_duration;
    if (all.far.elastostatic_acts)
      state.get<StaticFarFieldState>().stored = balance.far_field_energy;
    EnergyAccounts stored;
    for (const ForceOperator<2> *each : operators_with(acting.nodal))
      each->add_stored_energy(state, stored);
    if (all.beams)
      all.beams->add_stored_energy(state, stored);
    find_energies(state, stored);
  }

  void ImplicitSolver::book_work(const State<2> &state,
                                 const Configuration &configuration,
                                 EnergyAccounts &energy) const
  {
    // Work by the trapezoidal rule, of loads and of reactions of prescribed
    // motions; that of released forces counts as damping.
    const auto &held    = state.get<ImplicitState>().held;
    const double left_0 = 1. - state.get<ImplicitState>().released;
    const double left_1 = 1. - configuration.released;
    const double mean   = 0.5 * (left_0 + left_1);
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double u = configuration.nodes[i].u[d] - state.nodes[i].u[d];
        double force   = 0.5 * (start.external[i][d] + balance.external[i][d]);
        const double out_of_balance
            = 0.5 * (start.force[i][d] + balance.force[i][d]);
        if (dof_map->is_free(i, d))
          energy.damping += out_of_balance * u;
        else if (!dof_map->is_in_body(i))
          force -= out_of_balance;
        energy.external += force * u;
        if (!held.empty())
          energy.damping -= mean * held[2 * i + d] * u;
      }
    if (all.far.elastostatic_acts)
      for (unsigned int k = 0; k < all.far.elastostatic->nodes().size(); ++k)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int node = all.far.elastostatic->nodes()[k];
          energy.external
              += state.get<StaticFarFieldState>().held[2 * k + d]
                 * (configuration.nodes[node].u[d] - state.nodes[node].u[d]);
        }
    // Moments are in balance about the arms of their own configuration.
    const Configuration before = configuration_of(dof_map->bodies(), state);
    dof_map->update_arms(before);
    const auto forces_0
        = body_forces(dof_map->bodies(), start.force, communicator);
    dof_map->update_arms(configuration);
    const auto forces_1
        = body_forces(dof_map->bodies(), balance.force, communicator);
    for (unsigned int b = 0; b < before.bodies.size(); ++b)
    {
      const RigidBody &body = dof_map->bodies()[b];
      if (!body.counts)
        continue;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const double u      = configuration.bodies[b][d] - before.bodies[b][d];
        const double forces = 0.5 * (forces_0[b][d] + forces_1[b][d]);
        const double drives = 0.5 * (start.drives[b][d] + balance.drives[b][d]);
        energy.external += u * (body.given[d] ? -forces : drives);
        if (!body.given[d])
          energy.damping += u * (forces + drives);
      }
    }
  }

  std::array<double, 3> ImplicitSolver::resultant(const std::string &load) const
  {
    std::array<double, 3> result{};
    const auto found
        = std::find_if(acting.constraints.begin(), acting.constraints.end(),
                       [&](const MotionConstraint<2> *constraint)
                       { return constraint->name() == load; });
    if (found == acting.constraints.end() || balance.force.empty())
      return result;
    if ((*found)->traits().is_rigid_body())
    {
      const auto forces
          = body_forces(dof_map->bodies(), balance.force, communicator);
      for (unsigned int b = 0; b < forces.size(); ++b)
        if (dof_map->bodies()[b].platen == *found)
          for (unsigned int d = 0; d < 3; ++d)
            result[d] = dof_map->bodies()[b].given[d] ? -forces[b][d]
                                                      : balance.drives[b][d];
      return result;
    }
    if (*found == all.far.elastostatic)
      result = balance.far_field_force;
    else if ((*found)->traits().kind == MotionKind::prescribed)
      for (const DofMap::Prescribed &given : dof_map->prescribed())
      {
        if (given.part != &(*(*found)->parts())[given.component])
          continue;
        const auto &X      = model.nodes().point(given.node);
        const double force = -balance.force[given.node][given.component];
        result[given.component] += force;
        result[2] += given.component == 0 ? -X[1] * force : X[0] * force;
      }
    MPI_Allreduce(MPI_IN_PLACE, result.data(), 3, MPI_DOUBLE, MPI_SUM,
                  communicator);
    return result;
  }

  std::string ImplicitSolver::worst_place() const
  {
    // The largest unbalanced force, on a node or, if all bodies are rigid, on a
    // body; a joint if it has nearly as much.
    const unsigned int n_owned = model.nodes().n_owned();
    std::vector<bool> on_joint(model.nodes().n_local(), false);
    for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
      for (unsigned int k = 0; k < 2; ++k)
      {
        on_joint[model.joints().segments()[i].lower[k]] = true;
        on_joint[model.joints().segments()[i].upper[k]] = true;
      }
    double largest     = -1.;
    unsigned int worst = 0;
    const auto compare = [&](const unsigned int node, const double force)
    {
      const double counts = force * (on_joint[node] ? joint_preference : 1.);
      if (counts <= largest)
        return;
      largest = counts;
      worst   = node;
    };
    for (unsigned int i = 0; i < n_owned; ++i)
    {
      double square = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        if (dof_map->is_free(i, d))
          square += balance.force[i][d] * balance.force[i][d];
      if (!dof_map->is_in_body(i))
        compare(i, std::sqrt(square));
    }
    const auto forces
        = body_forces(dof_map->bodies(), balance.force, communicator);
    for (unsigned int b = 0; b < forces.size(); ++b)
      for (unsigned int d = 0; d < dim; ++d)
        if (const RigidBody &body = dof_map->bodies()[b];
            !body.given[d] && !body.nodes.empty())
          compare(body.nodes.front(),
                  std::abs(forces[b][d] + balance.drives[b][d]
                           + balance.held[b][d]));

    const double most  = dealii::Utilities::MPI::max(largest, communicator);
    const bool is_here = largest >= 0. && largest == most;
    for (const std::string &text : dealii::Utilities::MPI::all_gather(
             communicator, is_here ? describe_node(worst) : std::string()))
      if (!text.empty())
        return text;
    return "nowhere";
  }

  void ImplicitSolver::fail(const State<2> &state, const double tried,
                            const bool jumped) const
  {
    acting.check_finite(stage, state, state.load_time);
    acting.check_finite(stage, state, state.load_time + tried * stage_duration);
    const std::string where = worst_place();
    std::ostringstream message;
    message << "no equilibrium was found beyond "
            << (state.get<ImplicitState>().released < 1.
                    ? number_text(100. * state.get<ImplicitState>().released)
                          + " % of what was out of balance at the start"
                    : "the load time " + number_text(state.load_time) + " of "
                          + number_text(stage_duration) + " s")
            << (jumped ? ", and the model kept moving when it was released "
                         "against a viscous drag, after steps were reduced to "
                       : ", although steps were reduced to ")
            << number_text(tried)
            << " of the stage. Forces are out of balance most " << where
            << ". The model may have reached its limit load there"
            << (parameters.path == PathFollowing::never
                    ? ": 'Path following = automatic' in section 'Implicit' "
                      "could follow it down"
                    : "")
            << "; otherwise lower 'Largest step', raise 'Maximum "
               "iterations', or look at the strengths of those joints. The "
               "last equilibrium is kept.";
    throw ModelFailure(message.str());
  }

  std::string ImplicitSolver::describe_node(const unsigned int node) const
  {
    const NodeMap<2> &nodes = model.nodes();
    std::ostringstream text;
    text << "in block " << nodes.block_of_node(node) << " at ("
         << nodes.point(node)[0] << ", " << nodes.point(node)[1] << ") m";
    for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
    {
      const auto &segment = model.joints().segments()[i];
      for (unsigned int k = 0; k < 2; ++k)
        if (segment.lower[k] == node || segment.upper[k] == node)
        {
          const auto &[a, b] = nodes.faces().joints[segment.face].blocks;
          text << ", at a joint of the set '" << set_names[segment.set]
               << "' between the blocks " << a << " and " << b;
          return text.str();
        }
    }
    return text.str();
  }
} // namespace quoin
