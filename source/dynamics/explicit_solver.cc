// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/loading_rate.h>
#include <quoin/dynamics/state_checks.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  template <int dim>
  ExplicitSolver<dim>::ExplicitSolver(
      Model<dim> &model, const std::vector<LoadParameters> &loads,
      const std::vector<StageParameters> &stages,
      std::unique_ptr<FarField> far_field,
      std::unique_ptr<StaticFarField> static_field)
    : Solver<dim>(model, loads, std::move(far_field), std::move(static_field)),
      block_contacts(model.contacts()),
      stepper(model.nodes(), model.blocks(), time_shares),
      node_mass(model.mass()), all_stages(stages)
  {
    if constexpr (dim == 2)
      if (model.parameters().contact.has_box)
        box = std::make_unique<const ModelBox>(model);
    for (const LoadParameters &load : loads)
      if (load.has_added_mass)
      {
        if constexpr (dim == 2)
          reservoirs.emplace_back(load, model.nodes(), model.thickness());
        else
          throw InputError("section 'Loads/" + load.name
                           + "': 'Added mass' is known in two dimensions "
                             "alone. Set it to 'none'.");
      }
  }

  template <int dim>
  std::array<double, 3>
  ExplicitSolver<dim>::resultant(const std::string &load) const
  {
    if (!this->has_added_mass(load))
      return Solver<dim>::resultant(load);
    std::array<double, 3> sums{};
    for (unsigned int r = 0; r < reservoir_masses.size(); ++r)
      for (const NodeMass<dim> &mass : reservoir_masses[r])
      {
        if (reservoirs[r].name() != load)
          continue;
        const NodeVector<dim> force = stepper.inertia_force(mass);
        for (unsigned int d = 0; d < dim; ++d)
          sums[d] += force.v[d];
        if constexpr (dim == 2)
        {
          const dealii::Point<2> p = model.nodes().point(mass.node);
          sums[2] += p[0] * force.v[1] - p[1] * force.v[0];
        }
      }
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_DOUBLE, MPI_SUM,
                  communicator);
    return sums;
  }

  template <int dim>
  double ExplicitSolver<dim>::added_water() const
  {
    double trace = 0.;
    for (const NodeMass<dim> &each : water_mass)
      for (unsigned int d = 0; d < dim; ++d)
        trace += each.mass[d][d];
    return sum(trace);
  }

  template <int dim>
  void ExplicitSolver<dim>::prepare(State<dim> &state) const
  {
    Solver<dim>::prepare(state);
    if constexpr (dim == 2)
      if (block_contacts)
        block_contacts->prepare(state);
  }

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
    // 3. Forces of blocks and motion of their nodes, tile by tile.
    stepper.advance_tiles(state, context, requests.balance, sums);
    // 4. Motion of nodes that several processes share.
    stepper.advance_shared_nodes(state, context, requests.balance, sums);
    // 5. Rigid blocks and beams.
    advance_rigid_blocks(state, context, sums);
    advance_beams(state, context, sums);
    // 6. Constrained nodes.
    move_constrained_nodes(state, context);
    // 7. Work and energies; exchange of ghost positions.
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
    if (requests.balance)
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
      if (!all_beams)
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
            + kinetic_energy(water_mass, velocity_before, state.velocity, share)
            + model.rigid_blocks().kinetic_energy(
                rigid_stage, rigid_before,
                state.template get<RigidBlockStates>(), share);
      if constexpr (dim == 2)
        if (all_beams)
          stored_before.kinetic += beam_motion->kinetic_energy(state, share);
      this->find_energies(state, stored_before);
    }
    if (context.dt_before != context.dt)
      account_for_new_step(state, context);
    if (requests.balance)
    {
      state.unbalanced_ratio = stepper.unbalanced_ratio(state, context, sums);
      this->check_finite(state);
      check_cells(model, state, stage.loads);
      check_time_step(state);
      if constexpr (dim == 2)
        if (all_beams)
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
          + squared_change(water_mass, velocity_before, state.velocity)
          + model.rigid_blocks().squared_change(
              rigid_stage, rigid_before,
              state.template get<RigidBlockStates>());
    if constexpr (dim == 2)
      if (all_beams)
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
    AlignedArray<NodeVector<dim>> unused(state.nodes.size(), NodeVector<dim>{});
    if constexpr (dim == 2)
    {
      const StepContext context = step_context(state, stage, time_step);
      const NodeForces<2> forces{ unused.data(), nullptr };
      if (block_contacts)
      {
        state.template get<ContactState>().next_check
            = -1; // search nothing to look
        block_contacts->update(context, state);
        block_contacts->add_forces(context, state, forces);
      }
      if (all_beams)
        all_beams->add_forces(context, state, forces);
      if (!model.reinforcement().empty())
        model.reinforcement().add_forces(context, state, forces);
    }
    model.joints().add_forces(state.nodes.data(),
                              state.template get<JointHistoryOf<dim>>(),
                              state.energy, unused.data());
    state.energy.plastic += model.blocks().update(
        state.nodes.data(), state.template get<PlasticHistory>());
    model.nodes().exchange().update_ghosts(state.velocity.data());
  }

  template class ExplicitSolver<2>;
  template class ExplicitSolver<3>;
} // namespace quoin
