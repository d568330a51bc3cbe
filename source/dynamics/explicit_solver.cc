// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/loading_rate.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Share of the kinetic energy's rate that adaptive damping takes. */
    constexpr double adaptive_power_share = 0.5;
    /** Change of its coefficient in one step. */
    constexpr double adaptive_change = 1.005;

    double norm(const NodeVector<2> &f)
    {
      return std::sqrt(f.v[0] * f.v[0] + f.v[1] * f.v[1]);
    }
  } // namespace

  ExplicitSolver::ExplicitSolver(Model &model,
                                 const std::vector<LoadParameters> &loads,
                                 const std::vector<StageParameters> &stages,
                                 std::unique_ptr<FarField> far_field,
                                 std::unique_ptr<StaticFarField> static_field)
    : Solver(model, loads, std::move(far_field), std::move(static_field)),
      mass(model.mass()), box(model), all_stages(stages)
  {
    const NodeExchange &exchange = model.exchange();
    if (model.large_displacements())
      block_contacts = std::make_unique<BlockContacts>(
          model.nodes(), model.joints(), model.contact_model());
    force.assign(exchange.n_local(), NodeVector<2>{ { 0., 0. } });
    viscous_force.assign(exchange.n_local(), NodeVector<2>{ { 0., 0. } });
  }

  void ExplicitSolver::prepare(State<2> &state) const
  {
    Solver::prepare(state);
    if (block_contacts)
      block_contacts->prepare(state);
  }

  StepContext ExplicitSolver::step_context(const State<2> &state) const
  {
    const double in_stage = state.load_time;
    const double advance  = state.load_rate * time_step;
    StepContext context;
    context.dt                = time_step;
    context.dt_before         = state.previous_time_step;
    context.dt_velocity       = 0.5 * (time_step + state.previous_time_step);
    context.load_rate         = state.load_rate;
    context.begin             = { in_stage, state.stage_start + in_stage };
    context.middle            = { in_stage + 0.5 * advance,
                                  state.stage_start + in_stage + 0.5 * advance };
    context.stiffness_damping = stage.stiffness_coefficient;
    context.end
        = { in_stage + advance, state.stage_start + in_stage + advance };
    context.local_damping = stage.local_coefficient;
    context.mass_damping  = stage.damping == DampingType::adaptive
                                ? state.adaptive_damping
                                : stage.mass_coefficient;
    return context;
  }

  void ExplicitSolver::step(State<2> &state, const Requests &wanted)
  {
    Requests requests = wanted;
    if (stage.slows_loads() && requests.balance)
      requests.energies = true;
    const StepContext context = step_context(state);
    const bool step_changes   = context.dt_before != context.dt;
    time_shares.begin_step();
    state.energy += state.pending;
    state.pending = EnergyAccounts();
    if (requests.balance && box.is_given())
      look_at_box(state);

    // 1. Who touches whom.
    update_neighbours(state, context);
    // 2. Forces of contacts, joints and loads on all nodes.
    add_forces(state, context);
    const StoredEnergies stored
        = requests.energies ? stored_energies(state) : StoredEnergies();
    if (requests.energies || step_changes)
    {
      velocity_before = state.velocity;
      rigid_before    = state.get<RigidBlockStates>();
    }
    StepSums sums;
    if (requests.balance)
      sums.applied = applied_force();
    // 3. Blocks tile by tile, and the motion of the nodes that are theirs.
    advance_tiles(state, context, requests, sums);
    // 4. Nodes of blocks that several processes share.
    advance_shared_nodes(state, context, requests, sums);
    // 5. Rigid blocks.
    advance_rigid_blocks(state, context, sums);
    // 6. Nodes whose motion is not their own.
    move_constrained_nodes(state, context);
    // 7. Work and energies; positions go to the processes that mirror them.
    book_energies(state, context, requests, stored, sums);
    exchange_positions(state);
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
    for (const ForceOperator<2> *forces : forces_on)
      stored.joint += forces->stored_energy(state);
    time_shares.lap(phases.energies);
    return stored;
  }

  void ExplicitSolver::book_energies(State<2> &state,
                                     const StepContext &context,
                                     const Requests &requests,
                                     const StoredEnergies &stored,
                                     const StepSums &sums)
  {
    for (const ForceOperator<2> *forces : forces_on)
      state.pending.external
          += 0.5 * context.dt
             * forces->external_power(context.begin, state.velocity.data());
    state.energy.damping += sums.damping.before;
    state.pending.damping += sums.damping.after;
    if (stage.damping == DampingType::adaptive)
      adapt_damping(state, sums.damping);
    if (requests.energies)
      find_energies(state, stored.strain, stored.joint,
                    kinetic_energy(state, context));
    if (context.dt_before != context.dt)
      account_for_new_step(state, context);
    if (requests.balance)
    {
      find_ratio(state, context, sums.applied, sums.unbalanced);
      check_finite(state);
      check_cells(state);
    }
    time_shares.lap(phases.energies);
  }

  void ExplicitSolver::exchange_positions(State<2> &state)
  {
    model.exchange().update_ghosts(state.nodes.data());
    time_shares.lap(phases.exchange);
  }

  double ExplicitSolver::kinetic_energy(const State<2> &state,
                                        const StepContext &context) const
  {
    // 1/2 m v- v+, or the same half work on from v- if the step changed.
    const double part = context.dt_before / context.dt_velocity;
    double kinetic    = model.rigid_blocks().kinetic_energy(
           rigid_stage, rigid_before, state.get<RigidBlockStates>(), part);
    for (unsigned int i = 0; i < model.n_deformable_nodes(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double before = velocity_before[i].v[d];
        kinetic += 0.5 * mass[i] * before
                   * (before + part * (state.velocity[i].v[d] - before));
      }
    return kinetic;
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

  void ExplicitSolver::account_for_new_step(State<2> &state,
                                            const StepContext &context) const
  {
    // The kinetic energy that fits the trapezoidal work of the steps h1 before
    // and h2 from now differs by (h1^2 - h2^2) m a^2 / 8. At the start of the
    // run h1 = 0: the energy of the half step that starts from rest.
    const double factor
        = (context.dt_before * context.dt_before - context.dt * context.dt)
          / (8. * context.dt_velocity * context.dt_velocity);
    double energy
        = factor
          * model.rigid_blocks().squared_change(rigid_stage, rigid_before,
                                                state.get<RigidBlockStates>());
    for (unsigned int i = 0; i < model.n_deformable_nodes(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double change = state.velocity[i].v[d] - velocity_before[i].v[d];
        energy += factor * mass[i] * change * change;
      }
    state.pending.external += energy;
  }

  NodeForces<2> ExplicitSolver::node_forces()
  {
    return { force.data(), stage.stiffness_coefficient > 0.
                               ? viscous_force.data()
                               : nullptr };
  }

  void ExplicitSolver::update_neighbours(State<2> &state,
                                         const StepContext &context)
  {
    if (stage.stiffness_coefficient > 0.)
    {
      model.exchange().update_ghosts(state.velocity.data());
      time_shares.lap(phases.exchange);
    }
    // Before any force, because what is handed over to contacts is no joint
    // from then on.
    for (ForceOperator<2> *forces : forces_on)
      forces->update(context, state);
    time_shares.lap(phases.search);
  }

  void ExplicitSolver::add_forces(State<2> &state, const StepContext &context)
  {
    for (std::size_t i = 0; i < forces_on.size(); ++i)
    {
      forces_on[i]->add_forces(context, state, node_forces());
      state.energy.external += 0.5 * context.dt_before
                               * forces_on[i]->external_power(
                                   context.begin, state.velocity.data());
      time_shares.lap(force_phases[i]);
    }
    // What acts on partners is their owners' affair.
    for (unsigned int i
         = model.exchange().n_owned() + model.exchange().n_shared();
         i < model.exchange().n_local(); ++i)
      force[i] = viscous_force[i] = NodeVector<2>{ { 0., 0. } };
    for (const NodeRange &range : removed_nodes)
      std::fill(&force[range.begin], &force[range.begin] + range.size(),
                NodeVector<2>{ { 0., 0. } });
    if (state.stage_step == 0 && !loads_begun.empty())
      find_begun_forces(context);
  }

  void ExplicitSolver::find_begun_forces(const StepContext &context)
  {
    AlignedArray<NodeVector<2>> begun(force.size(),
                                      NodeVector<2>{ { 0., 0. } });
    for (const NodalLoad *load : loads_begun)
      load->add_forces(context.begin, begun.data());
    for (CapturedNode<2> &node : captured)
      node.begun = begun[node.node];
  }

  void ExplicitSolver::update_histories(State<2> &state)
  {
    AlignedArray<NodeVector<2>> unused(state.nodes.size(),
                                       NodeVector<2>{ { 0., 0. } });
    if (block_contacts)
    {
      state.get<ContactState>().next_check = -1; // search nothing to look
      const StepContext context            = step_context(state);
      block_contacts->update(context, state);
      block_contacts->add_forces(context, state, { unused.data(), nullptr });
    }
    model.joints().add_forces(state.nodes.data(), state.get<JointHistory>(),
                              state.energy, unused.data());
    state.energy.plastic += model.blocks().update(state.nodes.data(),
                                                  state.get<PlasticHistory>());
    model.exchange().update_ghosts(state.velocity.data());
  }

  void ExplicitSolver::capture(CapturedNode<2> &node,
                               const State<2> &state) const
  {
    node.force   = force[node.node];
    node.viscous = viscous_force[node.node];
    for (unsigned int d = 0; d < 2; ++d)
    {
      node.force.v[d] += node.viscous.v[d];
      node.displacement.v[d] = state.nodes[node.node].u[d];
    }
    node.velocity = state.velocity[node.node];
  }

  void ExplicitSolver::add_shared_forces(AlignedArray<NodeVector<2>> &values)
  {
    const NodeExchange &exchange = model.exchange();
    exchange.add_to_owners(values.data());
    const auto begin = values.begin() + exchange.n_owned();
    std::fill(begin, begin + exchange.n_shared(), NodeVector<2>{ { 0., 0. } });
  }

  double ExplicitSolver::applied_force() const
  {
    AlignedArray<NodeVector<2>> total = force;
    model.exchange().add_to_owners(total.data());
    double sum = 0.;
    for (unsigned int i = 0; i < model.exchange().n_owned(); ++i)
      sum += norm(total[i]);
    return sum;
  }

  void ExplicitSolver::advance_range(
      State<2> &state, const StepContext &context, const Requests &requests,
      const NodeRange &range, const unsigned int first_captured, StepSums &sums)
  {
    for (unsigned int c = captured_begin[first_captured];
         c < captured_begin[first_captured + 1]; ++c)
      capture(captured[c], state);
    if (requests.balance)
      for (std::size_t i = range.begin; i < range.end; ++i)
        if (inverse_mass[i] > 0.)
          sums.unbalanced += norm(force[i]);
    if (stage.damping == DampingType::none)
      return advance_nodes(
          range.begin, range.end, state.nodes.data(), state.velocity.data(),
          force.data(), inverse_mass.data(), context.dt_velocity, context.dt);
    const DampingFactors factors{ context.local_damping, context.mass_damping,
                                  context.dt_before, context.dt_velocity };
    const auto advance = stage.damping == DampingType::adaptive
                             ? advance_nodes_damped<true, 2>
                             : advance_nodes_damped<false, 2>;
    sums.damping += advance(range.begin, range.end, state.nodes.data(),
                            state.velocity.data(), force.data(),
                            viscous_force.data(), moving_mass.data(),
                            inverse_mass.data(), factors, context.dt);
  }

  void ExplicitSolver::advance_tiles(State<2> &state,
                                     const StepContext &context,
                                     const Requests &requests, StepSums &sums)
  {
    const BlockForces<2> &blocks = model.blocks();
    PlasticHistory &plastic      = state.get<PlasticHistory>();
    const bool viscous           = stage.stiffness_coefficient > 0.;
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
    {
      state.energy.plastic
          += blocks.add_forces(tile, state.nodes.data(), plastic, force.data());
      if (viscous)
        blocks.add_viscous_forces(
            tile, state.nodes.data(), state.velocity.data(),
            stage.stiffness_coefficient, viscous_force.data());
      advance_range(state, context, requests, blocks.tile_nodes(tile), tile,
                    sums);
    }
    time_shares.lap(phases.blocks);
  }

  void ExplicitSolver::advance_shared_nodes(State<2> &state,
                                            const StepContext &context,
                                            const Requests &requests,
                                            StepSums &sums)
  {
    add_shared_forces(force);
    if (stage.stiffness_coefficient > 0.)
      add_shared_forces(viscous_force);
    time_shares.lap(phases.exchange);
    advance_range(
        state, context, requests,
        { model.nodes().first_shared_node(), model.n_deformable_nodes() },
        model.blocks().n_tiles(), sums);
    time_shares.lap(phases.blocks);
  }

  void ExplicitSolver::advance_rigid_blocks(State<2> &state,
                                            const StepContext &context,
                                            StepSums &sums)
  {
    for (unsigned int c = captured_begin.back(); c < captured.size(); ++c)
      capture(captured[c], state);
    const RigidBlockWork work = model.rigid_blocks().advance(
        context, rigid_stage, force.data(), viscous_force.data(), state);
    sums.damping += work.damping;
    sums.unbalanced += work.unbalanced;
    time_shares.lap(phases.rigid_blocks);
  }

  void ExplicitSolver::move_constrained_nodes(State<2> &state,
                                              const StepContext &context)
  {
    // Components that nobody prescribes move by their own force.
    const double a = 0.5 * context.dt_velocity * context.mass_damping;
    for (const CapturedNode<2> &node : captured)
      for (unsigned int d = 0; d < 2; ++d)
      {
        if (node.owner[d])
          continue;
        const double v0    = node.velocity.v[d];
        const double gain  = context.dt_velocity / (1. + a) / node.mass;
        const double w     = (1. - a) / (1. + a) * v0 + gain * node.force.v[d];
        const double local = -local_damping_velocity(
            context.local_damping * gain * std::abs(node.force.v[d]), v0, w);
        const double v1 = w + local;
        const double drag
            = local / gain - context.mass_damping * node.mass * 0.5 * (v0 + v1);
        state.energy.damping -= 0.5 * context.dt_before * drag * v0;
        state.pending.damping -= 0.5 * context.dt * drag * v1;
        state.velocity[node.node].v[d] = v1;
        state.nodes[node.node].u[d] = node.displacement.v[d] + context.dt * v1;
      }
    time_shares.lap(phases.loads);
    for (std::size_t i = 0; i < constraints_on.size(); ++i)
    {
      constraints_on[i]->correct(context, captured, state);
      time_shares.lap(constraint_phases[i]);
    }
    for (std::size_t i = 0; i < constraints_on.size(); ++i)
    {
      constraints_on[i]->account(context, captured, state);
      time_shares.lap(constraint_phases[i]);
    }

    if (stage.stiffness_coefficient > 0.)
      for (const CapturedNode<2> &node : captured)
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double v1 = state.velocity[node.node].v[d];
          state.energy.damping -= 0.5 * context.dt_before * node.viscous.v[d]
                                  * node.velocity.v[d];
          state.pending.damping -= 0.5 * context.dt * node.viscous.v[d] * v1;
        }
    model.rigid_blocks().follow_nodes(rigid_stage, state);
    time_shares.lap(phases.loads);
  }

  void ExplicitSolver::adapt_damping(State<2> &state,
                                     const DampingWork &work) const
  {
    double sums[2] = { work.mass_power, work.kinetic_change };
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, communicator);
    if (state.adaptive_damping == 0.)
      state.adaptive_damping = 1e-3 / time_step;
    const double power = state.adaptive_damping * sums[0];
    const double rate  = std::abs(sums[1]) / time_step;
    if (power < adaptive_power_share * rate)
      state.adaptive_damping
          = std::min(adaptive_change * state.adaptive_damping, 0.5 / time_step);
    else
      state.adaptive_damping /= adaptive_change;
  }

  void ExplicitSolver::find_ratio(State<2> &state, const StepContext &context,
                                  double applied, double unbalanced)
  {
    // What nobody moves is unbalanced by its force, what a viscous boundary or
    // a far field moves by what accelerates it, the rest of which is what that
    // load does; what is prescribed is held by a reaction.
    for (const CapturedNode<2> &node : captured)
    {
      NodeVector<2> free{ { 0., 0. } }, held{ { 0., 0. } };
      for (unsigned int d = 0; d < 2; ++d)
        if (!node.owner[d])
          free.v[d] = node.force.v[d];
        else if (node.owner[d]->holds()[d] || node.owner[d]->is_rigid_body())
          held.v[d] = node.force.v[d];
        else
        {
          free.v[d] = node.mass
                      * (state.velocity[node.node].v[d] - node.velocity.v[d])
                      / context.dt_velocity;
          held.v[d] = free.v[d] - node.force.v[d];
        }
      unbalanced += norm(free);
      applied += norm(held);
    }
    double sums[2] = { applied, unbalanced };
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, communicator);
    for (const MotionConstraint<2> *constraint : constraints_on)
      sums[1] += constraint->unbalanced();
    state.unbalanced_ratio = sums[0] > 0. ? sums[1] / sums[0] : 0.;
  }
} // namespace quoin
