// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Checks of ExplicitSolver during a stage: blocks that have left the box, cells
// that have flowed too far for the step.

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/model/model_stability.h>
#include <quoin/model/block_placement.h>
#include <quoin/dynamics/explicit_solver.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  template <int dim>
  void ExplicitSolver<dim>::find_moved_blocks(const State<dim> &state)
  {
    std::vector<const MotionConstraint<dim> *> moving(
        acting.constraints.begin(), acting.constraints.end());
    for (std::size_t i = state.stage; i < all_stages.size(); ++i)
      for (const auto &constraint : all_constraints)
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

  template <int dim>
  void ExplicitSolver<dim>::check_time_step(const State<dim> &state) const
  {
    double flowed                 = 0.;
    const PlasticHistory &plastic = state.template get<PlasticHistory>();
    if constexpr (dim == 2)
      for (const PlasticCell &cell : plastic.cells)
        for (unsigned int i = 0; i < 3; ++i)
          flowed = std::max(flowed, std::abs(cell.inverse_stretch[i]));
    else
      for (const SpacePlasticCell &cell : plastic.space_cells)
        for (const double component : cell.inverse_stretch)
          flowed = std::max(flowed, std::abs(component));
    // The bound takes as long as some steps, and small flow changes it little.
    if (dealii::Utilities::MPI::max(flowed, communicator) < 0.05)
      return;
    const double eigenvalue
        = stability_at(model, state)
              .largest_eigenvalue(node_mass, rigid_stage.mass_factor);
    const double critical = StableTimeStep<dim>::critical(
        dealii::Utilities::MPI::max(eigenvalue, communicator),
        stage.stiffness_coefficient);
    if (time_step <= critical)
      return;
    throw ModelFailure(
        "plastic flow has deformed cells so much that the critical time step "
        "has fallen to "
        + number_text(critical) + " s, below the time step of "
        + number_text(time_step) + " s, at time " + number_text(state.time)
        + " s of stage '" + stage.name
        + "'. Lower 'Share of critical time step' (or 'Time step') in section "
          "'Time stepping' to "
        + number_text(0.8 * critical / time_step)
        + " of its value, or further if cells continue to yield; if only few "
          "cells have yielded, such as at a corner, make the mesh coarser "
          "there. The last checkpoint is kept.");
  }

  template <>
  void ExplicitSolver<2>::remove_blocks(const std::vector<BlockOutside> &found,
                                        State<2> &state)
  {
    state.energy.plastic += model.blocks().update(state.nodes.data(),
                                                  state.get<PlasticHistory>());
    const auto stored = [&]()
    {
      return model.joints().stored_energy(state)
             + model.blocks().stored_energy(state);
    };
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
    AlignedArray<NodeVector<dim>> force(state.nodes.size(), NodeVector<dim>{});
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
          double &v = state.velocity[i].v[d];
          if (!is_rigid)
            energy += 0.5 * (node_mass[i] * v + dt * force[i].v[d]) * v;
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

  template void ExplicitSolver<2>::check_time_step(const State<2> &) const;
  template void ExplicitSolver<3>::check_time_step(const State<3> &) const;
  template void ExplicitSolver<2>::find_moved_blocks(const State<2> &);
  template void ExplicitSolver<2>::hold_removed_blocks(const State<2> &);
  template void ExplicitSolver<3>::find_moved_blocks(const State<3> &);
  template void ExplicitSolver<3>::hold_removed_blocks(const State<3> &);
  template double
  ExplicitSolver<2>::stop_blocks(const std::vector<unsigned int> &, State<2> &);
  template double
  ExplicitSolver<3>::stop_blocks(const std::vector<unsigned int> &, State<3> &);
} // namespace quoin
