// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Where ExplicitSolver looks from time to time whether blocks have left the
// box.

#include <quoin/dynamics/explicit_solver.h>

#include <algorithm>

namespace quoin
{
  void ExplicitSolver::find_moved_blocks(const State<2> &state)
  {
    std::vector<const MotionConstraint<2> *> moving(constraints_on.begin(),
                                                    constraints_on.end());
    for (std::size_t i = state.stage; i < all_stages.size(); ++i)
      for (const auto &constraint : all_constraints)
        if (names_load(all_stages[i], constraint->name()))
          moving.push_back(constraint.get());
    const NodeMap<2> &nodes = model.nodes();
    moved_blocks.assign(nodes.block_parts().size(), false);
    for (const MotionConstraint<2> *constraint : moving)
      for (const unsigned int node : constraint->nodes())
        moved_blocks[nodes.find_part(nodes.block_of_node(node))] = true;
  }

  void ExplicitSolver::hold_removed_blocks(const State<2> &state)
  {
    if (state.block_marks.empty())
      return;
    const auto &parts               = model.nodes().block_parts();
    const unsigned int n_deformable = model.nodes().n_deformable_block_parts();
    for (unsigned int i = 0; i < parts.size(); ++i)
    {
      const unsigned int b = parts[i].number;
      if (!state.is_absent(b))
        continue;
      stepper.hold(model.block_nodes(b));
      if (i >= n_deformable)
        rigid_stage.held[i - n_deformable] = true;
    }
  }

  void ExplicitSolver::look_at_box(State<2> &state)
  {
    const auto found = box.look(state, moved_blocks);
    if (found.empty())
      return;
    blocks_outside.insert(blocks_outside.end(), found.begin(), found.end());
    if (std::any_of(found.begin(), found.end(),
                    [](const BlockOutside &block) { return block.removed; }))
      remove_blocks(found, state);
  }

  void ExplicitSolver::remove_blocks(const std::vector<BlockOutside> &found,
                                     State<2> &state)
  {
    state.energy.plastic += model.blocks().update(state.nodes.data(),
                                                  state.get<PlasticHistory>());
    const auto stored = [&]()
    {
      return model.joints().stored_energy(state.nodes.data(),
                                          state.get<JointHistory>())
             + model.blocks().strain_energy(state.nodes.data(),
                                            state.get<PlasticHistory>());
    };
    double energy = stored();
    for (unsigned int i = 0; i < model.joints().n_segments(); ++i)
      // What a removed block is still tied to was removed with it.
      if (model.is_at_absent_block(i, state))
        model.joints().let_go(i, state.get<JointHistory>());
    std::vector<unsigned int> blocks;
    for (const BlockOutside &block : found)
      if (block.removed && model.block_nodes(block.block).size() > 0)
        blocks.push_back(block.block);
    energy += stop_blocks(blocks, state);
    for (const unsigned int block : blocks)
      model.bring_to_rest(block, state);
    state.energy.external -= energy - stored();
    hold_removed_blocks(state);
    model.exchange().update_ghosts(state.nodes.data());
    block_contacts->search_anew(state.get<ContactState>());
  }

  double ExplicitSolver::stop_blocks(const std::vector<unsigned int> &blocks,
                                     State<2> &state)
  {
    // The forces at the present positions have not worked over the last half
    // step yet. Those of loads and damping never will, for the block is gone;
    // those of the cells change its strain energy by as much as its kinetic
    // energy, so both are taken as they would be after that half step.
    const double dt                 = state.previous_time_step;
    const RigidBlocks &rigid        = model.rigid_blocks();
    const auto rigid_0              = state.get<RigidBlockStates>();
    double energy                   = 0.;
    NodeVector<2> *force            = stepper.node_forces().force;
    const std::vector<double> &mass = stepper.mass();
    for (unsigned int tile = 0; tile < model.blocks().n_tiles(); ++tile)
      model.blocks().add_forces(tile, state.nodes.data(),
                                state.get<PlasticHistory>(), force);
    for (const unsigned int block : blocks)
    {
      const NodeRange range = model.block_nodes(block);
      const bool is_rigid   = model.table().is_rigid[block];
      for (std::size_t i = range.begin; i < range.end; ++i)
        for (unsigned int d = 0; d < 2; ++d)
        {
          double &v = state.velocity[i].v[d];
          if (!is_rigid)
            energy += 0.5 * (mass[i] * v + dt * force[i].v[d]) * v;
          v = 0.;
        }
      if (is_rigid)
        std::fill_n(
            state.get<RigidBlockStates>()[model.rigid_number(block)].velocity,
            3, 0.);
    }
    std::fill_n(force, state.nodes.size(), NodeVector<2>{});
    rigid_stage.mass_factor.resize(rigid.n_blocks(), 1.);
    return energy + rigid.kinetic_energy(rigid_stage, rigid_0, rigid_0, 1.)
           - rigid.kinetic_energy(rigid_stage, state.get<RigidBlockStates>(),
                                  state.get<RigidBlockStates>(), 1.);
  }
} // namespace quoin
