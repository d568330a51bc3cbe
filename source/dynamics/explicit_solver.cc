// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/loading_rate.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  ExplicitSolver::ExplicitSolver(Model &model,
                                 const std::vector<LoadParameters> &loads,
                                 const std::vector<StageParameters> &stages,
                                 std::unique_ptr<FarField> far_field,
                                 std::unique_ptr<StaticFarField> static_field)
    : Solver(model, loads, std::move(far_field), std::move(static_field)),
      stepper(model.nodes(), model.blocks(), time_shares), box(model),
      all_stages(stages)
  {
    stepper.set_mass(model.mass());
    if (model.large_displacements())
      block_contacts = std::make_unique<BlockContacts>(
          model.nodes(), model.joints(), model.contact_model());
  }

  void ExplicitSolver::prepare(State<2> &state) const
  {
    Solver::prepare(state);
    if (block_contacts)
      block_contacts->prepare(state);
  }

  void ExplicitSolver::step(State<2> &state, const Requests &wanted)
  {
    Requests requests = wanted;
    if (stage.slows_loads() && requests.balance)
      requests.energies = true;
    const StepContext context = stepper.context(state, time_step);
    const bool step_changes   = context.dt_before != context.dt;
    time_shares.begin_step();
    state.energy += state.pending;
    state.pending = EnergyAccounts();
    if (requests.balance && box.is_given())
      look_at_box(state);

    // 1. Who touches whom.
    stepper.update_neighbours(state, context);
    // 2. Forces of contacts, joints and loads on all nodes.
    stepper.add_forces(state, context);
    const StoredEnergies stored
        = requests.energies ? stored_energies(state) : StoredEnergies();
    if (requests.energies || step_changes)
    {
      stepper.keep_velocities(state);
      rigid_before = state.get<RigidBlockStates>();
    }
    StepSums sums;
    if (requests.balance)
      sums.applied = stepper.applied_force();
    // 3. Blocks tile by tile, and the motion of the nodes that are theirs.
    stepper.advance_tiles(state, context, requests.balance, sums);
    // 4. Nodes of blocks that several processes share.
    stepper.advance_shared_nodes(state, context, requests.balance, sums);
    // 5. Rigid blocks.
    advance_rigid_blocks(state, context, sums);
    // 6. Nodes whose motion is not their own.
    stepper.move_constrained_nodes(state, context);
    model.rigid_blocks().follow_nodes(rigid_stage, state);
    // 7. Work and energies; positions go to the processes that mirror them.
    book_energies(state, context, requests, stored, sums);
    stepper.exchange_positions(state);
    advance_time(state, context, requests);
  }

  ExplicitSolver::StoredEnergies
  ExplicitSolver::stored_energies(const State<2> &state)
  {
    // The cells' internal variables are still those of the step before.
    plastic_now = state.get<PlasticHistory>();
    model.blocks().update(state.nodes.data(), plastic_now);
    StoredEnergies stored;
    stored.strain
        = model.blocks().strain_energy(state.nodes.data(), plastic_now);
    stored.joint = stepper.stored_energy(state);
    time_shares.lap(energy_phase);
    return stored;
  }

  void ExplicitSolver::book_energies(State<2> &state,
                                     const StepContext &context,
                                     const Requests &requests,
                                     const StoredEnergies &stored,
                                     const StepSums &sums)
  {
    stepper.book_work(state, context, sums);
    if (requests.energies)
      find_energies(state, stored.strain, stored.joint,
                    stepper.kinetic_energy(state, context)
                        + model.rigid_blocks().kinetic_energy(
                            rigid_stage, rigid_before,
                            state.get<RigidBlockStates>(),
                            context.dt_before / context.dt_velocity));
    if (context.dt_before != context.dt)
      account_for_new_step(state, context);
    if (requests.balance)
    {
      state.unbalanced_ratio = stepper.unbalanced_ratio(state, context, sums);
      check_finite(state);
      check_cells(state);
    }
    time_shares.lap(energy_phase);
  }

  void ExplicitSolver::account_for_new_step(State<2> &state,
                                            const StepContext &context) const
  {
    // The kinetic energy that fits the trapezoidal work of the steps h1 before
    // and h2 from now differs by (h1^2 - h2^2) m a^2 / 8. At the start of the
    // run h1 = 0: the energy of the half step that starts from rest.
    const double factor
        = (context.dt_before * context.dt_before - context.dt * context.dt)
          / (8. * context.dt_velocity * context.dt_velocity);
    state.pending.external
        += factor
           * (stepper.squared_change(state)
              + model.rigid_blocks().squared_change(
                  rigid_stage, rigid_before, state.get<RigidBlockStates>()));
  }

  void ExplicitSolver::advance_time(State<2> &state, const StepContext &context,
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
    if (requests.balance && energies().throughput() > 0.)
      state.load_rate_growth = loading_rate::growth(
          energies().kinetic / (stage.kinetic_limit * energies().throughput()),
          balance_interval);
    state.load_rate
        = loading_rate::next(state.load_rate, state.load_rate_growth);
  }

  void ExplicitSolver::update_histories(State<2> &state)
  {
    AlignedArray<NodeVector<2>> unused(state.nodes.size(),
                                       NodeVector<2>{ { 0., 0. } });
    if (block_contacts)
    {
      state.get<ContactState>().next_check = -1; // search nothing to look
      const StepContext context            = stepper.context(state, time_step);
      block_contacts->update(context, state);
      block_contacts->add_forces(context, state, { unused.data(), nullptr });
    }
    model.joints().add_forces(state.nodes.data(), state.get<JointHistory>(),
                              state.energy, unused.data());
    state.energy.plastic += model.blocks().update(state.nodes.data(),
                                                  state.get<PlasticHistory>());
    model.exchange().update_ghosts(state.velocity.data());
  }

  void ExplicitSolver::advance_rigid_blocks(State<2> &state,
                                            const StepContext &context,
                                            StepSums &sums)
  {
    stepper.capture_rigid_blocks(state);
    const RigidBlockWork work = model.rigid_blocks().advance(
        context, rigid_stage, stepper.node_forces().force,
        stepper.viscous_forces(), state);
    sums.damping += work.damping;
    sums.unbalanced += work.unbalanced;
    time_shares.lap(rigid_phase);
  }

  // namespace quoin
} // namespace quoin
