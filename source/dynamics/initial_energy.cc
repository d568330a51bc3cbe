// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/stored_energy.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/initial_energy.h>
#include <quoin/mesh/global_geometry.h>

namespace quoin
{
  template <int dim>
  void refuse_moved_rigid_blocks(const Model<dim> &model,
                                 const State<dim> &state)
  {
    const NodeMap<dim> &nodes = model.nodes();
    unsigned int moved        = NodeMap<dim>::none;
    for (unsigned int i = nodes.n_deformable_nodes();
         i < nodes.n_owned() && moved == NodeMap<dim>::none; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (state.nodes[i].u[d] != 0. || state.velocity[i][d] != 0.)
          moved = i;
    dealii::Point<dim> p;
    if (first_point(nodes, moved, p))
      throw InputError(
          "section 'Initial motion': it moves the rigid block at "
          + point_text(p)
          + " m, but can be given to deformable blocks only. Make it 0 "
            "there, and give 'Velocity' and 'Spin' to the block by its name in "
            "section 'Blocks'.");
  }

  template <int dim>
  void account_for_initial_motion(const Model<dim> &model, State<dim> &state)
  {
    const NodeMap<dim> &nodes = model.nodes();
    // Internal variables of joints and cells are updated in the first step.
    State<dim> moving = state, rest = model.initial_state();
    EnergyAccounts lost;
    lost.plastic      = model.blocks().update(moving.nodes.data(),
                                              moving.template get<PlasticHistory>());
    const auto stored = [&](const State<dim> &s)
    { return stored_energy(s, model.blocks(), model.joints()); };
    AlignedArray<dealii::Tensor<1, dim>> unused(state.nodes.size(),
                                                dealii::Tensor<1, dim>());
    model.joints().add_forces(moving.nodes.data(),
                              moving.template get<JointHistoryOf<dim>>(), lost,
                              unused.data());
    double energy = stored(moving) - stored(rest) + lost.friction
                    + lost.fracture + lost.crushing + lost.plastic;
    for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
      energy += 0.5 * model.mass()[i] * state.velocity[i].norm_square();
    if constexpr (dim == 2)
      for (unsigned int b = 0; b < model.rigid_blocks().n_blocks(); ++b)
      {
        const RigidBlocks::Block &block = model.rigid_blocks().block(b);
        const double *v = state.template get<RigidBlockStates>()[b].velocity;
        energy += 0.5
                  * (block.mass * (v[0] * v[0] + v[1] * v[1])
                     + block.inertia * v[2] * v[2]);
      }
    state.energy.external += energy;
  }

  template void refuse_moved_rigid_blocks(const Model<2> &, const State<2> &);
  template void refuse_moved_rigid_blocks(const Model<3> &, const State<3> &);
  template void account_for_initial_motion(const Model<2> &, State<2> &);
  template void account_for_initial_motion(const Model<3> &, State<3> &);
} // namespace quoin
