// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// ExplicitSolver at the start of a stage; explicit_solver.cc has its steps.

#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/loading_rate.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/contact_bounds.h>
#include <quoin/model/material_waves.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace quoin
{
  namespace
  {
    /** Critical time steps in which forces may change, see quiet_time(). */
    constexpr double least_quiet_steps = 2000.;
  } // namespace

  template <int dim>
  void ExplicitSolver<dim>::scale_masses(const StageParameters &stage,
                                         const double start, State<dim> &state)
  {
    const RigidBlocks &rigid = model.rigid_blocks();
    rigid_stage.mass_factor.resize(rigid.n_blocks(), 1.);
    if constexpr (dim == 2)
      if (all_beams)
      {
        if (!beam_motion)
          beam_motion = std::make_unique<BeamMotion>(*all_beams, model.nodes());
        all_beams->begin_stage(stage.name, state);
      }
    const auto kinetic = [&]()
    {
      double energy = rigid.kinetic_energy(
          rigid_stage, state.template get<RigidBlockStates>(),
          state.template get<RigidBlockStates>(), 1.);
      for (unsigned int i = 0; i < model.nodes().n_deformable_nodes(); ++i)
        for (const double v : state.velocity[i].v)
          energy += 0.5 * node_mass[i] * v * v;
      energy += quoin::kinetic_energy(water_mass, state.velocity,
                                      state.velocity, 1.);
      if constexpr (dim == 2)
        if (all_beams)
          energy += beam_motion->kinetic_energy(state);
      return energy;
    };

    const double before      = kinetic();
    std::vector<double> mass = model.mass();
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
    {
      double &factor = rigid_stage.mass_factor[b];
      factor         = stage.scaled_time_step > 0.
                           ? model.stability().rigid_factor(b, stage.scaled_time_step)
                           : 1.;
      for (unsigned int i = rigid.block(b).begin; i < rigid.block(b).end; ++i)
        mass[i] *= factor;
    }
    if (stage.scaled_time_step > 0.)
      for (unsigned int i = 0; i < model.nodes().n_deformable_nodes(); ++i)
        mass[i] = std::max(
            mass[i], model.stability().mass_for(i, stage.scaled_time_step));
    double eigenvalue = find_beam_masses(stage, state, mass);
    added             = {};
    if (stage.scaled_time_step > 0.)
    {
      BeamMasses beams;
      if constexpr (dim == 2)
        if (all_beams)
          beams = beam_motion->masses(state);
      added = find_added_mass(model, mass, rigid_stage.mass_factor, beams,
                              stage.scaled_time_step);
    }
    node_mass = mass;
    find_water(stage, start);
    // A change of the mass of moving nodes is external work.
    state.energy.external += kinetic() - before;

    eigenvalue = std::max(eigenvalue, model.stability().largest_eigenvalue(
                                          mass, rigid_stage.mass_factor));
    for (const MotionConstraint<dim> *constraint : acting.constraints)
      eigenvalue = std::max(eigenvalue, constraint->largest_eigenvalue());
    if constexpr (dim == 2)
      if (water && water->acts())
        eigenvalue += water->largest_eigenvalue(mass);
    critical_step = StableTimeStep<dim>::critical(
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
        constraint->set_mass(mass, inertia, spin);
      }
  }

  template <>
  void ExplicitSolver<2>::find_water(const StageParameters &stage,
                                     const double start)
  {
    water_mass.clear();
    reservoir_masses.assign(reservoirs.size(), {});
    // Water has no inertia in what looks for equilibria.
    if (!stage.is_dynamic() || stage.pattern)
      return;
    for (unsigned int r = 0; r < reservoirs.size(); ++r)
      if (names_load(stage, reservoirs[r].name()))
      {
        reservoir_masses[r] = reservoirs[r].masses(start);
        water_mass          = merged(water_mass, reservoir_masses[r]);
      }
  }

  template <>
  void ExplicitSolver<3>::find_water(const StageParameters &, const double)
  {
  }

  template <int dim>
  void ExplicitSolver<dim>::check_levels(const State<dim> &state) const
  {
    for (unsigned int r = 0; r < reservoir_masses.size(); ++r)
      if (reservoirs[r].changes(state.time, stage.duration)
          && names_load(stage, reservoirs[r].name()) && stage.is_dynamic())
        throw InputError(
            "section 'Stages/" + stage.name + "': the level of the water of '"
            + reservoirs[r].name()
            + "' changes in a stage that follows motion, but 'Added mass' is "
              "that of a level that stands. Fill the reservoir in a stage "
              "before, or give this stage a load without added mass.");
  }

  template <int dim>
  void ExplicitSolver<dim>::refuse_heavy_constraints() const
  {
    if (reservoirs.empty())
      return;
    for (const MotionConstraint<dim> *constraint : acting.constraints)
    {
      if (constraint->traits().kind == MotionKind::prescribed)
        continue;
      unsigned int first = NodeMap<dim>::none;
      for (const NodeMass<dim> &each : water_mass)
        if (first == NodeMap<dim>::none
            && std::binary_search(constraint->nodes().begin(),
                                  constraint->nodes().end(), each.node))
          first = each.node;
      dealii::Point<dim> p;
      if (!first_point(model.nodes(), first, p))
        continue;
      throw InputError("section 'Stages/" + stage.name + "': the load '"
                       + constraint->name() + "' moves the node at "
                       + point_text(p)
                       + " m, to which a load with 'Added mass' adds water. "
                         "Only a prescribed motion can move both: end the face "
                         "below water where that load begins.");
    }
  }

  template <>
  double ExplicitSolver<2>::find_beam_masses(const StageParameters &stage,
                                             const State<2> &state,
                                             std::vector<double> &mass) const
  {
    if (!all_beams)
      return 0.;
    beam_motion->find_masses(stage.scaled_time_step, state);
    double eigenvalue                 = beam_motion->largest_eigenvalue(state);
    const double dt                   = stage.scaled_time_step;
    const std::vector<double> springs = beam_motion->interface_bound(state);
    for (unsigned int i = 0; i < springs.size(); ++i)
    {
      if (springs[i] == 0.)
        continue;
      if (dt > 0.)
        mass[i] = std::max(mass[i], model.stability().mass_for(i, dt)
                                        + 0.25 * dt * dt * springs[i]);
      eigenvalue
          = std::max(eigenvalue, model.stability().squared_frequency(i, mass[i])
                                     + springs[i] / mass[i]);
    }
    return eigenvalue;
  }

  template <>
  double ExplicitSolver<3>::find_beam_masses(const StageParameters &,
                                             const State<3> &,
                                             std::vector<double> &) const
  {
    return 0.;
  }

  template <int dim>
  void ExplicitSolver<dim>::collect_operators(const StageParameters *previous)
  {
    std::vector<ForceOperator<dim> *> forces, begun;
    if constexpr (dim == 2)
      if (block_contacts)
        forces.push_back(block_contacts);
    forces.push_back(&model.joints());
    if constexpr (dim == 2)
    {
      if (!model.reinforcement().empty())
        forces.push_back(&model.reinforcement());
      if (all_beams)
        forces.push_back(all_beams.get());
    }
    for (NodalLoad<dim> &load : all_loads)
      if (names_load(stage, load.name()))
      {
        forces.push_back(&load);
        if (previous && !names_load(*previous, load.name()))
          begun.push_back(&load);
      }
    if constexpr (dim == 2)
      if (water && water->acts())
      {
        forces.push_back(water);
        if (previous && !water->acts_in(previous->name))
          begun.push_back(water);
      }
    if (acting.pattern)
      forces.push_back(acting.pattern.get());
    forces.push_back(&acting.release);
    stepper.set_operators(forces, begun, acting.constraints, stage);
  }

  template <>
  void ExplicitSolver<2>::set_dashpots()
  {
    const NodeMap<2> &nodes = model.nodes();
    std::vector<std::uint8_t> is_held(nodes.table().n_blocks(), 0);
    for (const MotionConstraint<2> *constraint : acting.constraints)
      for (const unsigned int node : constraint->nodes())
        is_held[nodes.block_of_node(node)] = 1;
    const DashpotBlocks blocks = dashpot_blocks(model, is_held);
    model.joints().set_blocks(blocks);
    if (block_contacts)
      block_contacts->set_blocks(blocks);
    stepper.use_dashpots(model.joints().has_dashpots()
                         || (block_contacts && block_contacts->has_dashpots()));
  }

  template <int dim>
  void ExplicitSolver<dim>::collect_constrained_nodes(const State<dim> &state)
  {
    // Nodes of absent blocks do not move with constraints.
    stepper.capture_nodes(node_mass, water_mass, absent_nodes(model, state));
    this->refuse_shared_platens();
    refuse_heavy_constraints();
    if constexpr (dim == 2)
    {
      rigid_stage.held = this->find_held_blocks();
      set_dashpots();
    }
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
                       + "': 'Release duration = automatic' is twice the time "
                         "of a shear wave along the model, but all blocks are "
                         "rigid. Give a time in which forces may be released "
                         "without shaking the blocks.");
    return passage;
  }

  template <int dim>
  double ExplicitSolver<dim>::passage_time() const
  {
    // Masses that are added slow waves down.
    return 2. * model.nodes().table().diagonal() / slowest_shear_wave(model)
           * std::sqrt(1. + added.share);
  }

  template <int dim>
  double ExplicitSolver<dim>::quiet_time() const
  {
    return std::max(passage_time(), least_quiet_steps * critical_step);
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
  void ExplicitSolver<dim>::begin_stage(const StageParameters &new_stage,
                                        const StageParameters *previous,
                                        State<dim> &state)
  {
    this->activate(new_stage, state);
    prepare(state);
    if constexpr (dim == 2)
      if (water)
        water->begin_stage(stage.name, state);
    scale_masses(stage, state.time, state);
    acting.release = Release<dim>(state, stage, release_duration(state));
    this->ramp_gravity(previous, automatic_ramp());
    collect_operators(previous);
    for (const auto &constraint : all_constraints)
      if (!acts_in(*constraint, stage))
        constraint->rest(state);
    for (MotionConstraint<dim> *constraint : acting.constraints)
      constraint->begin_stage(state,
                              previous && acts_in(*constraint, *previous));
    collect_constrained_nodes(state);
    this->begin_pattern(previous, state);
    state.stage_start      = state.time;
    state.stage_step       = 0;
    state.load_time        = 0.;
    state.load_rate        = stage.slows_loads() ? loading_rate::start : 1.;
    state.load_rate_growth = 1.;
    state.adaptive_damping = 0.;
    state.unbalanced_ratio = 1.;
  }

  template <int dim>
  void ExplicitSolver<dim>::resume_stage(const StageParameters &resumed,
                                         const StageParameters *previous,
                                         State<dim> &state)
  {
    this->activate(resumed, state);
    if constexpr (dim == 2)
      if (water)
        water->resume_stage(state);
    collect_operators(nullptr);
    const State<dim> saved = state;
    scale_masses(stage, state.stage_start, state);
    acting.release = Release<dim>(state, stage, release_duration(state));
    this->ramp_gravity(previous, automatic_ramp());
    for (MotionConstraint<dim> *constraint : acting.constraints)
      constraint->resume_stage(state);
    state = saved;
    collect_constrained_nodes(state);
  }

  template double ExplicitSolver<2>::quiet_time() const;
  template void ExplicitSolver<2>::check_levels(const State<2> &) const;
  template double ExplicitSolver<3>::quiet_time() const;
  template void ExplicitSolver<3>::check_levels(const State<3> &) const;
  template void ExplicitSolver<2>::scale_masses(const StageParameters &, double,
                                                State<2> &);
  template void ExplicitSolver<2>::begin_stage(const StageParameters &,
                                               const StageParameters *,
                                               State<2> &);
  template void ExplicitSolver<2>::resume_stage(const StageParameters &,
                                                const StageParameters *,
                                                State<2> &);
  template void ExplicitSolver<3>::scale_masses(const StageParameters &, double,
                                                State<3> &);
  template void ExplicitSolver<3>::begin_stage(const StageParameters &,
                                               const StageParameters *,
                                               State<3> &);
  template void ExplicitSolver<3>::resume_stage(const StageParameters &,
                                                const StageParameters *,
                                                State<3> &);
} // namespace quoin
