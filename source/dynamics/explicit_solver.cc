// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/operators/stored_energy.h>
#include <quoin/base/exceptions.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/highest_frequency.h>
#include <quoin/dynamics/kinetic_energy.h>
#include <quoin/dynamics/largest_force.h>
#include <quoin/dynamics/state_checks.h>
#include <quoin/loading/constraint_checks.h>
#include <quoin/loading/load_growth.h>
#include <quoin/loading/loading_rate.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/contact_bounds.h>
#include <quoin/model/material_waves.h>
#include <quoin/model/model_stability.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** How much longer forces are released where materials yield: the overshoot
        of the stresses, which falls with the square of the duration, stays as
        plastic strain. */
    constexpr double yielding_release = 5.;
    /** Critical time steps in which forces may change, see quiet_time(). */
    constexpr double least_quiet_steps = 2000.;

    /** Marks the blocks of the mesh that @p constraint holds or moves: beside
        them those that they meet have all the mass that matters. Not so where a
        degree of freedom of a platen follows forces. */
    template <int dim>
    void mark_blocks(const NodeMap<dim> &nodes,
                     const MotionConstraint<dim> &constraint,
                     std::vector<std::uint8_t> &is_held)
    {
      const ConstraintTraits &traits = constraint.traits();
      if (traits.is_rigid_body()
          && !(traits.holds_rotation
               && std::all_of(traits.holds.begin(), traits.holds.end(),
                              [](const bool holds) { return holds; })))
        return;
      for (const unsigned int node : constraint.nodes())
        is_held[nodes.block_of_node(node)] = 1;
    }

    /** Collective. */
    template <int dim>
    bool cells_may_yield(const Model<dim> &model)
    {
      return dealii::Utilities::MPI::max(
                 unsigned(model.blocks().cell_data().is_plastic()),
                 model.nodes().communicator())
             > 0;
    }
  } // namespace

  template <int dim>
  ExplicitSolver<dim>::ExplicitSolver(
      Model<dim> &model, const std::vector<LoadParameters> &loads,
      const std::vector<StageParameters> &stages,
      std::unique_ptr<FarField> far_field,
      std::unique_ptr<StaticFarField> static_field)
    : Solver<dim>(model, loads, std::move(far_field), std::move(static_field)),
      block_contacts(model.operators().contacts),
      stepper(model.nodes(), model.blocks(), time_shares),
      node_mass(model.mass()), water(model, loads), all_stages(stages)
  {
    if constexpr (dim == 2)
      if (model.parameters().contact.has_box)
        box = std::make_unique<const ModelBox>(model);
  }

  template <int dim>
  Resultant<dim> ExplicitSolver<dim>::resultant(const std::string &load) const
  {
    return all.has_added_mass(load) ? water.resultant(load, stepper)
                                    : Solver<dim>::resultant(load);
  }

  template <int dim>
  void ExplicitSolver<dim>::prepare(State<dim> &state) const
  {
    Solver<dim>::prepare(state);
    state.template add<LargestForce>();
    if constexpr (dim == 2)
      if (block_contacts)
        block_contacts->prepare(state);
  }

  // -- a stage ----------------------------------------------------------------

  template <int dim>
  bool ExplicitSolver<dim>::keeps_bound() const
  {
    const auto &joints   = model.properties().joints;
    const bool is_damped = std::any_of(joints.begin(), joints.end(),
                                       [](const JointSetParameters &set)
                                       { return set.damping.acts(); });
    bool has_bars        = false;
    if constexpr (dim == 2)
      has_bars = !model.reinforcement().empty() || all.beams;
    bool is_explicit_beyond = false;
    if constexpr (dim == 2)
      is_explicit_beyond = all.far.elastodynamic
                           && all.far.elastodynamic->domain().scheme
                                  == CouplingScheme::staggered;
    return is_damped || has_bars || is_explicit_beyond
           || critical.added.share > 0. || cells_may_yield(model);
  }

  template <int dim>
  double
  ExplicitSolver<dim>::largest_eigenvalue(const StableTimeStep<dim> &stability)
  {
    const double bound = dealii::Utilities::MPI::max(
        stability.largest_eigenvalue(node_mass, rigid_stage.mass_factor),
        communicator);
    critical.gain = 1.;
    if (!takes_assembled_step || keeps_bound())
      return bound;
    const double found = highest_squared_frequency(
        model, node_mass, rigid_stage, known_frequencies);
    if (found <= 0. || found >= bound)
      return bound;
    critical.gain = std::sqrt(bound / found);
    return found;
  }

  template <>
  double ExplicitSolver<2>::largest_water_eigenvalue() const
  {
    auto bound               = all.water->stiffness_bound();
    const RigidBlocks &rigid = model.rigid_blocks();
    std::vector<double> rigid_bound;
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      rigid_bound.push_back(rigid.largest_eigenvalue(b, bound));
    std::fill(bound.begin() + model.nodes().n_deformable_nodes(), bound.end(),
              NodeStiffness<2>{});
    StableTimeStep<2> stability(bound);
    stability.set_rigid_blocks(rigid_bound);
    return dealii::Utilities::MPI::max(
        stability.largest_eigenvalue(node_mass, rigid_stage.mass_factor),
        communicator);
  }

  template <int dim>
  void ExplicitSolver<dim>::scale_masses(const StageParameters &stage,
                                         const double start, State<dim> &state)
  {
    const RigidBlocks &rigid = model.rigid_blocks();
    rigid_stage.mass_factor.resize(rigid.n_blocks(), 1.);
    if constexpr (dim == 2)
      if (all.beams)
      {
        if (!beam_motion)
          beam_motion = std::make_unique<BeamMotion>(*all.beams, model.nodes());
        all.beams->begin_stage(stage.name, state);
      }
    const auto kinetic = [&]()
    {
      double energy = rigid.kinetic_energy(
          rigid_stage, state.template get<RigidBlockStates>(),
          state.template get<RigidBlockStates>(), 1.);
      for (unsigned int i = 0; i < model.nodes().n_deformable_nodes(); ++i)
        energy += 0.5 * node_mass[i] * state.velocity[i].norm_square();
      energy += quoin::kinetic_energy(water.masses(), state.velocity,
                                      state.velocity, 1.);
      if constexpr (dim == 2)
        if (all.beams)
          energy += beam_motion->kinetic_energy(state);
      return energy;
    };

    const double before = kinetic();
    const StableTimeStep<dim> stability
        = stability_at(model, model.initial_state());
    const ScaledMasses<dim> masses(model, stability, stage.scaled_time_step,
                                   beam_motion.get(), state);
    node_mass               = masses.nodes;
    rigid_stage.mass_factor = masses.rigid_factor;
    critical.added          = masses.added;
    water.begin_stage(stage, start);
    // A change of the mass of moving nodes is external work.
    state.energy.external += kinetic() - before;

    double eigenvalue
        = std::max(masses.beam_eigenvalue, largest_eigenvalue(stability));
    for (const MotionConstraint<dim> *constraint : acting.constraints)
      eigenvalue
          = std::max(eigenvalue, constraint->traits().largest_eigenvalue);
    if constexpr (dim == 2)
      if (all.water && all.water->acts())
        eigenvalue += largest_water_eigenvalue();
    critical.length = StableTimeStep<dim>::critical(
        dealii::Utilities::MPI::max(eigenvalue, communicator),
        stage.stiffness_coefficient);
    for (MotionConstraint<dim> *constraint : acting.constraints)
      if (constraint->traits().is_rigid_body())
      {
        double inertia = 0., spin = 0.;
        for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
        {
          const RigidBlocks::Block &block = rigid.block(b);
          if (!std::binary_search(constraint->nodes().begin(),
                                  constraint->nodes().end(), block.begin))
            continue;
          const double factor = rigid_stage.mass_factor[b];
          const double omega
              = state.template get<RigidBlockStates>()[b].velocity[2];
          inertia += factor * (block.inertia - block.lumped_inertia);
          // Velocities of nodes follow from the mean arm of the last step.
          const double mean
              = 0.5 * (1. + std::cos(omega * state.previous_time_step));
          spin
              += factor * (block.inertia - mean * block.lumped_inertia) * omega;
        }
        constraint->set_mass(node_mass, inertia, spin);
      }
  }

  template <int dim>
  void ExplicitSolver<dim>::collect_operators(const StageParameters *previous)
  {
    std::vector<ForceOperator<dim> *> forces, begun;
    const ModelOperators<dim> own = model.operators();
    if constexpr (dim == 2)
      if (own.contacts)
        forces.push_back(own.contacts);
    forces.push_back(own.joints);
    if constexpr (dim == 2)
    {
      if (own.bars)
        forces.push_back(own.bars);
      if (all.beams)
        forces.push_back(all.beams.get());
    }
    for (NodalLoad<dim> &load : all.nodal)
      if (names_load(stage, load.name()))
      {
        forces.push_back(&load);
        if (previous && !names_load(*previous, load.name()))
          begun.push_back(&load);
      }
    if constexpr (dim == 2)
      if (all.water && all.water->acts())
      {
        forces.push_back(all.water);
        if (previous && !all.water->parameters().acts_in(previous->name))
          begun.push_back(all.water);
      }
    if (acting.pattern)
      forces.push_back(acting.pattern.get());
    forces.push_back(&acting.release);
    forces.push_back(&acting.arrival);
    stepper.set_operators(forces, begun, acting.constraints, stage);
  }

  template <int dim>
  void ExplicitSolver<dim>::set_dashpots()
  {
    const NodeMap<dim> &nodes = model.nodes();
    std::vector<std::uint8_t> is_held(nodes.table().n_blocks(), 0);
    for (const MotionConstraint<dim> *constraint : acting.constraints)
      mark_blocks(nodes, *constraint, is_held);
    model.set_held_blocks(is_held);
    const DashpotBlocks blocks = dashpot_blocks(model);
    model.operators().joints->dashpots.set_blocks(blocks);
    if (block_contacts)
      block_contacts->set_blocks(blocks);
    stepper.use_dashpots(
        model.joints().dashpots.act()
        || (block_contacts && block_contacts->dashpots().act()));
  }

  template <int dim>
  void ExplicitSolver<dim>::collect_constrained_nodes(const State<dim> &state)
  {
    // Nodes of absent blocks do not move with constraints.
    stepper.capture_nodes(node_mass, water.masses(),
                          absent_nodes(model, state));
    refuse_shared_platens(model, acting.constraints, stage);
    water.check_constraints(acting.constraints, stage);
    if constexpr (dim == 2)
      rigid_stage.held = find_held_blocks(model, acting.constraints, stage);
    find_moved_blocks(state);
    hold_removed_blocks(state);
    if (acting.pattern)
      acting.pattern->set_mobility(node_mass, acting.constraints, rigid_stage,
                                   quiet_time());
  }

  template <int dim>
  double ExplicitSolver<dim>::release_duration(const State<dim> &state) const
  {
    const auto &held = state.template get<ConstructionState<dim>>().held;
    if (std::none_of(held.begin(), held.end(),
                     [](const HeldForces<dim> &item)
                     { return item.left != item.left_at_end; }))
      return 0.;
    if (stage.release_duration >= 0.)
      return stage.release_duration;
    if (stage.end == StageEnd::time)
      return stage.duration;

    const double passage = passage_time();
    if (passage == 0.)
      throw InputError("section 'Stages/" + stage.name
                       + "': 'Release duration = automatic' follows from the "
                         "time of a shear wave along the model, but all blocks "
                         "are rigid. Give a time in which forces may be "
                         "released without shaking the blocks.");
    return cells_may_yield(model) ? yielding_release * passage : passage;
  }

  template <int dim>
  double ExplicitSolver<dim>::passage_time() const
  {
    // Masses that are added slow waves down.
    return 2. * model.nodes().table().diagonal() / slowest_shear_wave(model)
           * std::sqrt(1. + critical.added.share);
  }

  template <int dim>
  double ExplicitSolver<dim>::quiet_time() const
  {
    return std::max(passage_time(), least_quiet_steps * critical.length);
  }

  template <int dim>
  double ExplicitSolver<dim>::automatic_ramp() const
  {
    // Weight and initial stress may be in balance from the start.
    return stage.end == StageEnd::static_ratio
                   && model.parameters().initial_stresses.empty()
               ? quiet_time()
               : 0.;
  }

  template <int dim>
  void ExplicitSolver<dim>::begin_arrival(const StageParameters *previous,
                                          State<dim> &state) const
  {
    auto &placed = state.template get<LoadGrowth>().placed;
    for (PlacedGrowth &each : placed)
    {
      each.growth         = each.growth.after(state.load_time);
      const auto has_left = [&](const unsigned int load)
      { return !names_load(stage, all.nodal[load].name()); };
      each.loads.erase(
          std::remove_if(each.loads.begin(), each.loads.end(), has_left),
          each.loads.end());
      const auto is_gone
          = [&](const unsigned int block) { return state.is_absent(block); };
      each.blocks.erase(
          std::remove_if(each.blocks.begin(), each.blocks.end(), is_gone),
          each.blocks.end());
    }
    placed.erase(std::remove_if(placed.begin(), placed.end(),
                                [](const PlacedGrowth &each)
                                { return each.growth.rest() == 0.; }),
                 placed.end());
    if (stage.fill.empty() || stage.end != StageEnd::static_ratio)
      return;
    // Placed blocks have no stress that their weight may balance. Loads that
    // begin in this stage have ramps of their own, and what boundaries that
    // begin take over counts these whole; uplift changes with its crack.
    PlacedGrowth begun;
    bool is_heavy = false;
    for (unsigned int i = 0; i < all.nodal.size(); ++i)
    {
      const NodalLoad<dim> &load = all.nodal[i];
      if (!names_load(stage, load.name()))
        continue;
      if (load.traits().is_gravity)
      {
        begun.growth.duration = std::max(begun.growth.duration,
                                         load.ramp_where_begun(quiet_time()));
        is_heavy              = true;
      }
      if (previous && names_load(*previous, load.name())
          && !load.traits().follows_crack)
        begun.loads.push_back(i);
    }
    if (!is_heavy)
      begun.growth.duration = quiet_time();
    const BlockTable<dim> &table = model.nodes().table();
    const auto fills             = find_groups(
                    table, stage.fill, "section 'Stages/" + stage.name + "', 'Fill'");
    for (unsigned int b = 0; b < table.n_blocks(); ++b)
      if (fills[table.group[b]])
        begun.blocks.push_back(b);
    placed.push_back(std::move(begun));
  }

  template <int dim>
  void ExplicitSolver<dim>::grow_on_placed(const State<dim> &state)
  {
    const NodeMap<dim> &nodes = model.nodes();
    acting.arrival            = {};
    for (const PlacedGrowth &each : state.template get<LoadGrowth>().placed)
    {
      std::vector<const NodalLoad<dim> *> loads;
      for (const unsigned int load : each.loads)
        loads.push_back(&all.nodal[load]);
      std::vector<unsigned int> placed;
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        if (std::binary_search(each.blocks.begin(), each.blocks.end(),
                               nodes.block_of_node(i)))
          placed.push_back(i);
      acting.arrival.add(placed, loads, nodes.n_local(), each.growth);
    }
    if constexpr (dim == 2)
      if (all.water)
        all.water->let_grow(this->growing_water(state));
  }

  template <int dim>
  void ExplicitSolver<dim>::begin_stage(const StageParameters &new_stage,
                                        const StageParameters *previous,
                                        State<dim> &state)
  {
    this->activate(new_stage, previous, state);
    prepare(state);
    if constexpr (dim == 2)
      if (all.water)
        all.water->begin_stage(stage.name, state);
    set_dashpots();
    scale_masses(stage, state.next_load_start(), state);
    acting.release
        = Release<dim>(state, stage.releases_linearly.value_or(false),
                       release_duration(state));
    this->begin_growth(previous, automatic_ramp(), state);
    begin_arrival(previous, state);
    grow_on_placed(state);
    collect_operators(previous);
    for (const auto &constraint : all.constraints)
      if (!all.acts_in(*constraint, stage))
        constraint->rest(state);
    for (MotionConstraint<dim> *constraint : acting.constraints)
      constraint->begin_stage(state,
                              previous && all.acts_in(*constraint, *previous));
    if constexpr (dim == 2)
      if (all.far.elastostatic_acts && all.far.elastodynamic && previous
          && all.acts_in(*all.far.elastodynamic, *previous))
        all.far.elastostatic->follow(*all.far.elastodynamic, state);
    collect_constrained_nodes(state);
    this->begin_pattern(previous, state);
    state.begin_clocks();
    state.load_rate        = stage.slows_loads() ? loading_rate::start : 1.;
    state.load_rate_growth = 1.;
    state.adaptive_damping = 0.;
    state.unbalanced_ratio = 1.;
    state.template get<LargestForce>().applied = 0.;
  }

  template <int dim>
  void ExplicitSolver<dim>::resume_stage(const StageParameters &resumed,
                                         const StageParameters *previous,
                                         State<dim> &state)
  {
    this->activate(resumed, nullptr, state);
    if constexpr (dim == 2)
      if (all.water)
        all.water->resume_stage(state);
    collect_operators(nullptr);
    const State<dim> saved = state;
    set_dashpots();
    scale_masses(stage, state.load_start(), state);
    acting.release
        = Release<dim>(state, stage.releases_linearly.value_or(false),
                       release_duration(state));
    this->resume_growth(previous, state);
    grow_on_placed(state);
    for (MotionConstraint<dim> *constraint : acting.constraints)
      constraint->resume_stage(state);
    state = saved;
    collect_constrained_nodes(state);
  }

  // -- a step -----------------------------------------------------------------

  template <int dim>
  void ExplicitSolver<dim>::step(State<dim> &state, const Requests &wanted)
  {
    Requests requests = wanted;
    requests.energies |= stage.slows_loads() && requests.balance;
    StepSums sums;
    const StepContext context = begin_step(state, requests);
    // 1. Contact search.
    stepper.update_neighbours(state, context);
    // 2. Forces of contacts, joints and loads on all nodes.
    add_forces(state, context, requests, sums);
    // 3. Forces of blocks and motion of their nodes.
    stepper.advance_blocks(state, context, requests.any_ratio(), sums);
    // 4. Rigid blocks and beams.
    advance_rigid_blocks(state, context, sums);
    advance_beams(state, context, sums);
    // 5. Constrained nodes.
    move_constrained_nodes(state, context);
    // 6. Work and energies; exchange of ghost positions.
    end_step(state, context, requests, sums);
  }

  template <int dim>
  StepContext ExplicitSolver<dim>::begin_step(State<dim> &state,
                                              const Requests &requests)
  {
    time_shares.begin_step();
    state.energy += state.pending;
    state.pending = EnergyAccounts();
    if constexpr (dim == 2)
      if (requests.balance && box)
        look_at_box(state);
    return step_context(state, stage, time_step);
  }

  template <int dim>
  void ExplicitSolver<dim>::add_forces(State<dim> &state,
                                       const StepContext &context,
                                       const Requests &requests, StepSums &sums)
  {
    stepper.add_forces(state, context);
    if (requests.energies)
      find_stored_energies(state);
    if (requests.energies || context.dt_before != context.dt)
    {
      velocity_before = state.velocity;
      rigid_before    = state.template get<RigidBlockStates>();
    }
    if (requests.any_ratio())
      sums.applied = stepper.applied_force();
  }

  template <int dim>
  void ExplicitSolver<dim>::find_stored_energies(const State<dim> &state)
  {
    // The cells' internal variables are still those of the previous step.
    plastic_now = state.template get<PlasticHistory>();
    model.blocks().update(state.nodes.data(), plastic_now);
    stored_before = EnergyAccounts();
    stored_before.strain
        = strain_energy(model.blocks(), state.nodes.data(), plastic_now);
    stepper.add_stored_energy(state, stored_before);
    time_shares.lap(energy_phase);
  }

  template <int dim>
  void ExplicitSolver<dim>::advance_rigid_blocks(State<dim> &state,
                                                 const StepContext &context,
                                                 StepSums &sums)
  {
    if constexpr (dim == 2)
    {
      const NodeForces<2> forces = stepper.capture_rigid_blocks(state);
      const RigidBlockWork work  = model.rigid_blocks().advance(
           context, rigid_stage, forces.force, forces.viscous, state);
      sums.damping += work.damping;
      sums.unbalanced += work.unbalanced;
      time_shares.lap(rigid_phase);
    }
  }

  template <int dim>
  void ExplicitSolver<dim>::advance_beams(State<dim> &state,
                                          const StepContext &context,
                                          StepSums &sums)
  {
    if constexpr (dim == 2)
    {
      if (!all.beams)
        return;
      const BeamMotion::Work work
          = beam_motion->advance(context, stage.damping != DampingType::none,
                                 stage.damping == DampingType::adaptive, state);
      sums.damping += work.damping;
      sums.unbalanced += work.unbalanced;
      sums.applied += work.applied;
      time_shares.lap(beam_phase);
    }
  }

  template <int dim>
  void ExplicitSolver<dim>::move_constrained_nodes(State<dim> &state,
                                                   const StepContext &context)
  {
    stepper.move_constrained_nodes(state, context);
    if constexpr (dim == 2)
      model.rigid_blocks().follow_nodes(rigid_stage, state);
    if (acting.pattern)
    {
      acting.pattern->correct(context, state);
      time_shares.lap(load_phase);
    }
  }

  template <int dim>
  void
  ExplicitSolver<dim>::end_step(State<dim> &state, const StepContext &context,
                                const Requests &requests, const StepSums &sums)
  {
    book_energies(state, context, requests, sums);
    stepper.exchange_positions(state);
    advance_time(state, context, requests);
  }

  template <int dim>
  void ExplicitSolver<dim>::book_energies(State<dim> &state,
                                          const StepContext &context,
                                          const Requests &requests,
                                          const StepSums &sums)
  {
    stepper.book_work(state, context, sums);
    if (requests.energies)
    {
      // 1/2 m v- v+, or the same half work on from v- if the step changed.
      const double share = context.dt_before / context.dt_velocity;
      stored_before.kinetic
          = kinetic_energy(model.nodes(), node_mass, velocity_before,
                           state.velocity, share)
            + kinetic_energy(water.masses(), velocity_before, state.velocity,
                             share)
            + model.rigid_blocks().kinetic_energy(
                rigid_stage, rigid_before,
                state.template get<RigidBlockStates>(), share);
      if constexpr (dim == 2)
        if (all.beams)
          stored_before.kinetic += beam_motion->kinetic_energy(state, share);
      this->find_energies(state, stored_before);
    }
    if (context.dt_before != context.dt)
      account_for_new_step(state, context);
    if (requests.any_ratio())
      state.unbalanced_ratio
          = stepper.unbalanced_ratio(state, context, sums, requests.balance);
    if (requests.balance)
    {
      this->check_finite(state);
      check_cells(model, state, stage.loads);
      check_time_step(model, state, stage, node_mass, rigid_stage.mass_factor,
                      time_step);
      if constexpr (dim == 2)
        if (all.beams)
          beam_motion->check_finite(state);
    }
    time_shares.lap(energy_phase);
  }

  template <int dim>
  void
  ExplicitSolver<dim>::account_for_new_step(State<dim> &state,
                                            const StepContext &context) const
  {
    // The kinetic energy consistent with the trapezoidal work of the last step
    // h1 and the next one h2 differs by (h1^2 - h2^2) m a^2 / 8. At the start
    // of the run h1 = 0: the energy of the half step that starts from rest.
    const double factor
        = (context.dt_before * context.dt_before - context.dt * context.dt)
          / (8. * context.dt_velocity * context.dt_velocity);
    double change
        = squared_change(model.nodes(), node_mass, velocity_before,
                         state.velocity)
          + squared_change(water.masses(), velocity_before, state.velocity)
          + model.rigid_blocks().squared_change(
              rigid_stage, rigid_before,
              state.template get<RigidBlockStates>());
    if constexpr (dim == 2)
      if (all.beams)
        change += beam_motion->squared_change(state);
    state.pending.external += factor * change;
  }

  template <int dim>
  void ExplicitSolver<dim>::advance_time(State<dim> &state,
                                         const StepContext &context,
                                         const Requests &requests) const
  {
    ++state.step;
    ++state.stage_step;
    state.time               = state.stage_start + state.stage_step * time_step;
    state.previous_time_step = time_step;
    if (!stage.slows_loads())
    {
      state.load_time = state.time - state.stage_start;
      return;
    }
    state.load_time = context.end.stage;
    if (requests.balance && this->energies().throughput() > 0.)
      state.load_rate_growth = loading_rate::growth(
          this->energies().kinetic
              / (stage.kinetic_limit * this->energies().throughput()),
          balance_interval);
    state.load_rate
        = loading_rate::next(state.load_rate, state.load_rate_growth);
  }

  template <int dim>
  void ExplicitSolver<dim>::update_histories(State<dim> &state)
  {
    AlignedArray<dealii::Tensor<1, dim>> unused(state.nodes.size(),
                                                dealii::Tensor<1, dim>());
    if constexpr (dim == 2)
    {
      const StepContext context = step_context(state, stage, time_step);
      const NodeForces<2> forces{ unused.data(), nullptr };
      if (block_contacts)
      {
        state.template get<ContactState>().next_check = ContactState::never;
        block_contacts->update(context, state);
        block_contacts->add_forces(context, state, forces);
      }
      if (all.beams)
        all.beams->add_forces(context, state, forces);
      if (Reinforcement *bars = model.operators().bars)
        bars->add_forces(context, state, forces);
    }
    model.joints().add_forces(state.nodes.data(),
                              state.template get<JointHistoryOf<dim>>(),
                              state.energy, unused.data());
    state.energy.plastic += model.blocks().update(
        state.nodes.data(), state.template get<PlasticHistory>());
    model.nodes().exchange().update_ghosts(state.velocity.data());
  }

  // -- blocks that go -------------------------------------------------------

  template <int dim>
  void ExplicitSolver<dim>::find_moved_blocks(const State<dim> &state)
  {
    std::vector<const MotionConstraint<dim> *> moving(
        acting.constraints.begin(), acting.constraints.end());
    for (std::size_t i = state.stage; i < all_stages.size(); ++i)
      for (const auto &constraint : all.constraints)
        if (names_load(all_stages[i], constraint->name()))
          moving.push_back(constraint.get());
    const NodeMap<dim> &nodes = model.nodes();
    moved_blocks.assign(nodes.blocks().parts.size(), false);
    for (const MotionConstraint<dim> *constraint : moving)
      for (const unsigned int node : constraint->nodes())
        moved_blocks[nodes.blocks().find(nodes.block_of_node(node))] = true;
  }

  template <int dim>
  void ExplicitSolver<dim>::hold_removed_blocks(const State<dim> &state)
  {
    if (state.block_marks.empty())
      return;
    const BlockTable<dim> &table = model.nodes().table();
    for (unsigned int b = 0; b < table.n_blocks(); ++b)
    {
      if (!state.is_absent(b))
        continue;
      const auto nodes = owned_nodes(model, b);
      stepper.hold(nodes);
      if (table.is_rigid[b] && !nodes.empty())
        rigid_stage.held[rigid_number(model, b)] = true;
    }
  }

  template <>
  void ExplicitSolver<2>::look_at_box(State<2> &state)
  {
    const auto found = box->find_outside(state, moved_blocks);
    if (found.empty())
      return;
    blocks_outside.insert(blocks_outside.end(), found.begin(), found.end());
    if (std::any_of(found.begin(), found.end(),
                    [](const BlockOutside &block) { return block.removed; }))
      remove_blocks(found, state);
  }

  template <>
  void ExplicitSolver<2>::remove_blocks(const std::vector<BlockOutside> &found,
                                        State<2> &state)
  {
    state.energy.plastic += model.blocks().update(state.nodes.data(),
                                                  state.get<PlasticHistory>());
    const auto stored = [&]()
    { return stored_energy(state, model.joints(), model.blocks()); };
    double energy = stored();
    for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
      // Blocks still tied to a removed block were removed with it.
      if (is_at_absent_block(model, i, state))
        detach_joint(i, state.get<JointHistory>());
    std::vector<unsigned int> blocks;
    for (const BlockOutside &block : found)
      if (block.removed)
        blocks.push_back(block.block);
    energy += stop_blocks(blocks, state);
    bring_to_rest(model, blocks, state);
    state.energy.external -= energy - stored();
    hold_removed_blocks(state);
    model.nodes().exchange().update_ghosts(state.nodes.data());
    block_contacts->search_anew(state.get<ContactState>());
  }

  template <int dim>
  double
  ExplicitSolver<dim>::stop_blocks(const std::vector<unsigned int> &blocks,
                                   State<dim> &state)
  {
    // The forces at the present positions have not yet done work over the last
    // half step. Loads and damping will not, as the block is removed; the cells
    // change strain and kinetic energy by the same amount, so both are taken as
    // after that half step.
    const double dt          = state.previous_time_step;
    const RigidBlocks &rigid = model.rigid_blocks();
    const auto rigid_0       = state.template get<RigidBlockStates>();
    double energy            = 0.;
    AlignedArray<dealii::Tensor<1, dim>> force(state.nodes.size(),
                                               dealii::Tensor<1, dim>());
    for (unsigned int tile = 0; tile < model.blocks().n_tiles(); ++tile)
      model.blocks().add_forces(tile, state.nodes.data(),
                                state.template get<PlasticHistory>(),
                                force.data());
    model.nodes().exchange().add_to_owners(force.data());
    for (const unsigned int block : blocks)
    {
      const auto nodes    = owned_nodes(model, block);
      const bool is_rigid = model.nodes().table().is_rigid[block];
      for (const unsigned int i : nodes)
        for (unsigned int d = 0; d < dim; ++d)
        {
          double &v = state.velocity[i][d];
          if (!is_rigid)
            energy += 0.5 * (node_mass[i] * v + dt * force[i][d]) * v;
          v = 0.;
        }
      if (is_rigid && !nodes.empty())
        std::fill_n(
            state.template get<RigidBlockStates>()[rigid_number(model, block)]
                .velocity,
            3, 0.);
    }
    rigid_stage.mass_factor.resize(rigid.n_blocks(), 1.);
    return energy + rigid.kinetic_energy(rigid_stage, rigid_0, rigid_0, 1.)
           - rigid.kinetic_energy(rigid_stage,
                                  state.template get<RigidBlockStates>(),
                                  state.template get<RigidBlockStates>(), 1.);
  }

  template class ExplicitSolver<2>;
  template class ExplicitSolver<3>;
} // namespace quoin
