// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/block_forces_3d.h>
#include <quoin/dynamics/central_differences.h>
#include <quoin/dynamics/largest_force.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <iterator>

namespace quoin
{
  namespace
  {
    /** Power of adaptive damping by the rate of kinetic energy [-]. */
    constexpr double adaptive_power_share = 0.5;
    /** Factor of its coefficient in one step [-]. */
    constexpr double adaptive_change = 1.005;

  } // namespace

  template <int dim>
  StepContext step_context(const State<dim> &state,
                           const StageParameters &stage, const double dt)
  {
    const double in_stage = state.load_time, start = state.load_start();
    const double advance = state.load_rate * dt;
    StepContext result;
    result.dt          = dt;
    result.dt_before   = state.previous_time_step;
    result.dt_velocity = 0.5 * (dt + state.previous_time_step);
    result.load_rate   = state.load_rate;
    result.begin       = { in_stage, start + in_stage };
    result.middle
        = { in_stage + 0.5 * advance, start + in_stage + 0.5 * advance };
    result.stiffness_damping = stage.stiffness_coefficient;
    result.end           = { in_stage + advance, start + in_stage + advance };
    result.local_damping = stage.local_coefficient;
    result.mass_damping  = stage.damping == DampingType::adaptive
                               ? state.adaptive_damping
                               : stage.mass_coefficient;
    return result;
  }

  template <int dim>
  CentralDifferences<dim>::CentralDifferences(const NodeMap<dim> &nodes,
                                              const BlockForces<dim> &blocks,
                                              PhaseClock &clock)
    : nodes(nodes), exchange(nodes.exchange()), blocks(blocks),
      clock(clock), phases{ clock.phase("blocks"), clock.phase("search"),
                            clock.phase("loads"), clock.phase("exchange") },
      force_sum(exchange), viscous_sum(exchange)
  {
    force.assign(exchange.n_local(), dealii::Tensor<1, dim>());
    viscous_force.assign(exchange.n_local(), dealii::Tensor<1, dim>());
  }

  // -- a stage ---------------------------------------------------------------

  template <int dim>
  void CentralDifferences<dim>::set_operators(
      const std::vector<ForceOperator<dim> *> &new_forces,
      const std::vector<ForceOperator<dim> *> &new_begun,
      const std::vector<MotionConstraint<dim> *> &new_constraints,
      const StageParameters &new_stage)
  {
    forces      = new_forces;
    begun       = new_begun;
    constraints = new_constraints;
    stage       = new_stage;
    last_power.clear();
    force_phases.clear();
    for (const ForceOperator<dim> *each : forces)
      force_phases.push_back(clock.phase(each->kind()));
    constraint_phases.clear();
    for (const MotionConstraint<dim> *constraint : constraints)
      constraint_phases.push_back(clock.phase(constraint->traits().phase));
  }

  template <int dim>
  void CentralDifferences<dim>::capture_nodes(
      const std::vector<double> &mass, const std::vector<NodeMass<dim>> &added,
      const std::vector<bool> &absent)
  {
    std::vector<unsigned int> moved;
    for (const NodeMass<dim> &each : added)
      if (!absent[each.node])
        moved.push_back(each.node);
    for (const MotionConstraint<dim> *constraint : constraints)
      std::copy_if(constraint->nodes().begin(), constraint->nodes().end(),
                   std::back_inserter(moved),
                   [&](const unsigned int node) { return !absent[node]; });
    std::sort(moved.begin(), moved.end());
    moved.erase(std::unique(moved.begin(), moved.end()), moved.end());

    captured.assign(moved.size(), CapturedNode<dim>{});
    for (unsigned int c = 0; c < moved.size(); ++c)
    {
      captured[c].node = moved[c];
      captured[c].mass = mass[moved[c]];
    }
    for (MotionConstraint<dim> *constraint : constraints)
    {
      std::vector<unsigned int> positions;
      for (const unsigned int node : constraint->nodes())
      {
        if (absent[node])
          continue;
        positions.push_back(std::lower_bound(moved.begin(), moved.end(), node)
                            - moved.begin());
        for (unsigned int d = 0; d < dim; ++d)
          if (constraint->traits().moves(d))
            captured[positions.back()].owner[d] = constraint;
      }
      constraint->bind(std::move(positions));
    }
    heavy.capture(added, absent, captured);

    const auto first_at = [&](const unsigned int node) {
      return std::lower_bound(moved.begin(), moved.end(), node) - moved.begin();
    };
    const auto has_shared_nodes = [&](const unsigned int tile)
    {
      const NodeRange range = blocks.tile_cells(tile);
      for (std::size_t cell = range.begin; cell < range.end; ++cell)
        for (const unsigned int node : nodes.cells().nodes[cell])
          if (node >= nodes.first_shared_node())
            return true;
      return false;
    };
    tiles.resize(blocks.n_tiles());
    std::iota(tiles.begin(), tiles.end(), 0U);
    n_tiles_at_others
        = std::stable_partition(tiles.begin(), tiles.end(), has_shared_nodes)
          - tiles.begin();

    captured_begin.clear();
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      captured_begin.push_back(first_at(blocks.tile_nodes(tile).begin));
    captured_begin.push_back(first_at(nodes.first_shared_node()));
    captured_begin.push_back(first_at(nodes.n_deformable_nodes()));

    held.clear();
    moving_mass = mass;
    inverse_mass.resize(mass.size());
    for (unsigned int i = 0; i < mass.size(); ++i)
      inverse_mass[i] = 1. / mass[i];
    for (const unsigned int node : moved)
      moving_mass[node] = inverse_mass[node] = 0.;
  }

  template <int dim>
  void CentralDifferences<dim>::hold(const std::vector<unsigned int> &nodes)
  {
    held.insert(held.end(), nodes.begin(), nodes.end());
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    for (const unsigned int node : nodes)
      moving_mass[node] = inverse_mass[node] = 0.;
    last_power.clear();
  }

  // -- the parts of a step ---------------------------------------------------

  template <int dim>
  void CentralDifferences<dim>::update_neighbours(State<dim> &state,
                                                  const StepContext &context)
  {
    if (has_viscous_forces())
    {
      exchange.update_ghosts(state.velocity.data());
      clock.lap(phases.exchange);
    }
    // Before any force: segments handed over to contacts are no longer joints.
    for (ForceOperator<dim> *each : forces)
      each->update(context, state);
    clock.lap(phases.search);
  }

  template <int dim>
  void CentralDifferences<dim>::add_forces(State<dim> &state,
                                           const StepContext &context)
  {
    const NodeForces<dim> sum{ force.data(), has_viscous_forces()
                                                 ? viscous_force.data()
                                                 : nullptr };
    for (std::size_t i = 0; i < forces.size(); ++i)
    {
      forces[i]->add_forces(context, state, sum);
      // Velocities are still those of the last step.
      const bool is_known
          = !last_power.empty()
            && forces[i]->has_same_power(last_begin, context.begin);
      state.energy.external
          += 0.5 * context.dt_before
             * (is_known ? last_power[i]
                         : forces[i]->external_power(context.begin,
                                                     state.velocity.data()));
      clock.lap(force_phases[i]);
    }
    // Forces on partner nodes are booked by their owners.
    for (unsigned int i = exchange.n_owned() + exchange.n_shared();
         i < exchange.n_local(); ++i)
      force[i] = viscous_force[i] = dealii::Tensor<1, dim>();
    for (const unsigned int node : held)
      force[node] = dealii::Tensor<1, dim>();
    if (state.stage_step == 0 && !begun.empty())
      find_begun_forces(context, state);
  }

  template <int dim>
  void CentralDifferences<dim>::find_begun_forces(const StepContext &context,
                                                  State<dim> &state)
  {
    AlignedArray<dealii::Tensor<1, dim>> sum(force.size(),
                                             dealii::Tensor<1, dim>());
    for (ForceOperator<dim> *load : begun)
      load->add_forces(context, state, { sum.data(), nullptr });
    for (CapturedNode<dim> &node : captured)
      node.begun = sum[node.node];
  }

  template <int dim>
  void CentralDifferences<dim>::capture(CapturedNode<dim> &node,
                                        const State<dim> &state) const
  {
    node.force   = force[node.node];
    node.viscous = viscous_force[node.node];
    for (unsigned int d = 0; d < dim; ++d)
    {
      node.force[d] += node.viscous[d];
      node.displacement[d] = state.nodes[node.node].u[d];
    }
    node.velocity = state.velocity[node.node];
  }

  template <int dim>
  void CentralDifferences<dim>::finish_sum(
      OwnerSum<dealii::Tensor<1, dim>> &sum,
      AlignedArray<dealii::Tensor<1, dim>> &values)
  {
    sum.finish(values.data());
    const auto begin = values.begin() + exchange.n_owned();
    std::fill(begin, begin + exchange.n_shared(), dealii::Tensor<1, dim>());
  }

  template <int dim>
  double CentralDifferences<dim>::applied_force() const
  {
    AlignedArray<dealii::Tensor<1, dim>> total = force;
    exchange.add_to_owners(total.data());
    double sum = 0.;
    for (unsigned int i = 0; i < exchange.n_owned(); ++i)
      sum += total[i].norm();
    return sum;
  }

  template <int dim>
  void CentralDifferences<dim>::advance_range(
      State<dim> &state, const StepContext &context, const bool balance,
      const NodeRange &range, const unsigned int first_captured, StepSums &sums)
  {
    for (unsigned int c = captured_begin[first_captured];
         c < captured_begin[first_captured + 1]; ++c)
      capture(captured[c], state);
    if (balance)
      for (std::size_t i = range.begin; i < range.end; ++i)
        if (inverse_mass[i] > 0.)
          sums.unbalanced += force[i].norm();
    if (stage.damping == DampingType::none && !dashpots)
      return advance_nodes(
          range.begin, range.end, state.nodes.data(), state.velocity.data(),
          force.data(), inverse_mass.data(), context.dt_velocity, context.dt);
    const DampingFactors factors{ context.local_damping, context.mass_damping,
                                  context.dt_before, context.dt_velocity };
    const auto advance = stage.damping == DampingType::adaptive
                             ? advance_nodes_damped<true, dim>
                             : advance_nodes_damped<false, dim>;
    sums.damping += advance(
        range.begin, range.end, state.nodes.data(), state.velocity.data(),
        force.data(), has_viscous_forces() ? viscous_force.data() : nullptr,
        moving_mass.data(), inverse_mass.data(), factors, context.dt);
  }

  template <int dim>
  void CentralDifferences<dim>::advance_tile(const unsigned int tile,
                                             State<dim> &state,
                                             const StepContext &context,
                                             const bool balance, StepSums &sums)
  {
    state.energy.plastic += blocks.add_forces(
        tile, state.nodes.data(), state.template get<PlasticHistory>(),
        force.data());
    if (stage.stiffness_coefficient > 0.)
      blocks.add_viscous_forces(tile, state.nodes.data(), state.velocity.data(),
                                stage.stiffness_coefficient,
                                viscous_force.data());
    advance_range(state, context, balance, blocks.tile_nodes(tile), tile, sums);
  }

  template <int dim>
  void CentralDifferences<dim>::advance_blocks(State<dim> &state,
                                               const StepContext &context,
                                               const bool balance,
                                               StepSums &sums)
  {
    advance_tiles(state, context, balance, sums);
    advance_shared_nodes(state, context, balance, sums);
  }

  template <int dim>
  void CentralDifferences<dim>::advance_tiles(State<dim> &state,
                                              const StepContext &context,
                                              const bool balance,
                                              StepSums &sums)
  {
    for (unsigned int i = 0; i < n_tiles_at_others; ++i)
      advance_tile(tiles[i], state, context, balance, sums);
    clock.lap(phases.blocks);
    force_sum.start(force.data());
    if (has_viscous_forces())
      viscous_sum.start(viscous_force.data());
    clock.lap(phases.exchange);
    for (unsigned int i = n_tiles_at_others; i < tiles.size(); ++i)
      advance_tile(tiles[i], state, context, balance, sums);
    clock.lap(phases.blocks);
  }

  template <int dim>
  void CentralDifferences<dim>::advance_shared_nodes(State<dim> &state,
                                                     const StepContext &context,
                                                     const bool balance,
                                                     StepSums &sums)
  {
    finish_sum(force_sum, force);
    if (has_viscous_forces())
      finish_sum(viscous_sum, viscous_force);
    clock.lap(phases.exchange);
    advance_range(state, context, balance,
                  { nodes.first_shared_node(), nodes.n_deformable_nodes() },
                  blocks.n_tiles(), sums);
    clock.lap(phases.blocks);
  }

  template <int dim>
  void
  CentralDifferences<dim>::move_constrained_nodes(State<dim> &state,
                                                  const StepContext &context)
  {
    // Free components move by their own force.
    const double a = 0.5 * context.dt_velocity * context.mass_damping;
    for (const CapturedNode<dim> &node : captured)
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (node.owner[d] || node.has_added_mass)
          continue;
        const double v0    = node.velocity[d];
        const double gain  = context.dt_velocity / (1. + a) / node.mass;
        const double w     = (1. - a) / (1. + a) * v0 + gain * node.force[d];
        const double local = -local_damping_velocity(
            context.local_damping * gain * std::abs(node.force[d]), v0, w);
        const double v1 = w + local;
        const double drag
            = local / gain - context.mass_damping * node.mass * 0.5 * (v0 + v1);
        state.energy.damping -= 0.5 * context.dt_before * drag * v0;
        state.pending.damping -= 0.5 * context.dt * drag * v1;
        state.velocity[node.node][d] = v1;
        state.nodes[node.node].u[d]  = node.displacement[d] + context.dt * v1;
      }
    clock.lap(phases.loads);
    // Dashpots need the velocities that are prescribed.
    for (const bool absorbs : { false, true })
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if ((constraints[i]->traits().kind == MotionKind::absorbing) == absorbs)
        {
          constraints[i]->correct(context, captured, state);
          clock.lap(constraint_phases[i]);
        }
    heavy.move(context, captured, state);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      constraints[i]->account(context, captured, state);
      clock.lap(constraint_phases[i]);
    }

    if (has_viscous_forces())
      for (const CapturedNode<dim> &node : captured)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double v1 = state.velocity[node.node][d];
          state.energy.damping
              -= 0.5 * context.dt_before * node.viscous[d] * node.velocity[d];
          state.pending.damping -= 0.5 * context.dt * node.viscous[d] * v1;
        }
    clock.lap(phases.loads);
  }

  template <int dim>
  void CentralDifferences<dim>::adapt_damping(State<dim> &state,
                                              const StepContext &context,
                                              const DampingWork &work) const
  {
    double sums[2] = { work.mass_power, work.kinetic_change };
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM,
                  exchange.communicator());
    if (state.adaptive_damping == 0.)
      state.adaptive_damping = 1e-3 / context.dt;
    const double power = state.adaptive_damping * sums[0];
    const double rate  = std::abs(sums[1]) / context.dt;
    if (power < adaptive_power_share * rate)
      state.adaptive_damping = std::min(
          adaptive_change * state.adaptive_damping, 0.5 / context.dt);
    else
      state.adaptive_damping /= adaptive_change;
  }

  template <int dim>
  void CentralDifferences<dim>::exchange_positions(State<dim> &state)
  {
    exchange.update_ghosts(state.nodes.data());
    clock.lap(phases.exchange);
  }

  template <int dim>
  NodeForces<dim>
  CentralDifferences<dim>::capture_rigid_blocks(const State<dim> &state)
  {
    for (unsigned int c = captured_begin.back(); c < captured.size(); ++c)
      capture(captured[c], state);
    return { force.data(),
             has_viscous_forces() ? viscous_force.data() : nullptr };
  }

  template <int dim>
  void CentralDifferences<dim>::book_work(State<dim> &state,
                                          const StepContext &context,
                                          const StepSums &sums)
  {
    last_power.clear();
    for (const ForceOperator<dim> *each : forces)
    {
      last_power.push_back(
          each->external_power(context.begin, state.velocity.data()));
      state.pending.external += 0.5 * context.dt * last_power.back();
    }
    last_begin = context.begin;
    state.energy.damping += sums.damping.before;
    state.pending.damping += sums.damping.after;
    if (stage.damping == DampingType::adaptive)
      adapt_damping(state, context, sums.damping);
  }

  // -- sums of a step ----------------------------------------------------

  template <int dim>
  void
  CentralDifferences<dim>::add_stored_energy(const State<dim> &state,
                                             EnergyAccounts &energies) const
  {
    for (const ForceOperator<dim> *each : forces)
      each->add_stored_energy(state, energies);
  }

  template <int dim>
  double CentralDifferences<dim>::unbalanced_ratio(State<dim> &state,
                                                   const StepContext &context,
                                                   StepSums sums,
                                                   const bool kept) const
  {
    /** Part of the largest applied force below which it has been taken away. */
    constexpr double unloaded = 1e-3;
    // The unbalanced force of a free component is its force; of one that a
    // viscous boundary or far field moves, mass times acceleration, as that
    // load takes the rest; a prescribed component has a reaction and none.
    for (const CapturedNode<dim> &node : captured)
    {
      dealii::Tensor<1, dim> free, reaction{};
      for (unsigned int d = 0; d < dim; ++d)
        if (!node.owner[d])
          free[d] = node.force[d];
        else if (node.owner[d]->traits().holds[d]
                 || node.owner[d]->traits().is_rigid_body())
          reaction[d] = node.force[d];
        else
        {
          free[d] = node.mass
                    * (state.velocity[node.node][d] - node.velocity[d])
                    / context.dt_velocity;
          reaction[d] = free[d] - node.force[d];
        }
      sums.unbalanced += free.norm();
      sums.applied += reaction.norm();
    }
    double all[2] = { sums.applied, sums.unbalanced };
    MPI_Allreduce(MPI_IN_PLACE, all, 2, MPI_DOUBLE, MPI_SUM,
                  exchange.communicator());
    for (const MotionConstraint<dim> *constraint : constraints)
      if (const RigidMotion<dim> *body = constraint->rigid_motion())
        all[1] += body->unbalanced();
    double &largest = state.template get<LargestForce>().applied;
    if (kept)
      largest = std::max(largest, all[0]);
    const double applied = std::max(all[0], unloaded * largest);
    return applied > 0. ? all[1] / applied : 0.;
  }

  template class CentralDifferences<2>;
  template class CentralDifferences<3>;
  template StepContext step_context(const State<2> &, const StageParameters &,
                                    double);
  template StepContext step_context(const State<3> &, const StageParameters &,
                                    double);
} // namespace quoin
