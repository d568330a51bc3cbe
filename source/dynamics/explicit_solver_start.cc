// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// ExplicitSolver before the first stage.

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/explicit_solver.h>

#include <sstream>

namespace quoin
{
  template <>
  void ExplicitSolver<2>::account_for_initial_motion(State<2> &state) const
  {
    unsigned int moved = NodeMap<2>::none;
    for (unsigned int i = model.n_deformable_nodes();
         i < model.exchange().n_owned() && moved == NodeMap<2>::none; ++i)
      for (unsigned int d = 0; d < 2; ++d)
        if (state.nodes[i].u[d] != 0. || state.velocity[i].v[d] != 0.)
          moved = i;
    dealii::Point<2> p;
    if (model.nodes().first_point(moved, p))
    {
      std::ostringstream message;
      message << "section 'Initial motion': it moves the rigid block at ("
              << p[0] << ", " << p[1]
              << ") m, but can be given to deformable blocks only. Make it 0 "
                 "there, or the block deformable.";
      throw InputError(message.str());
    }

    // Internal variables of joints and cells are updated in the first step.
    State<2> moving = state, rest = model.initial_state();
    AlignedArray<NodeVector<2>> unused(state.nodes.size(),
                                       NodeVector<2>{ { 0., 0. } });
    EnergyAccounts lost;
    model.joints().add_forces(moving.nodes.data(), moving.get<JointHistory>(),
                              lost, unused.data());
    lost.plastic      = model.blocks().update(moving.nodes.data(),
                                              moving.get<PlasticHistory>());
    const auto stored = [&](const State<2> &s)
    {
      return model.blocks().strain_energy(s.nodes.data(),
                                          s.get<PlasticHistory>())
             + model.joints().stored_energy(s.nodes.data(),
                                            s.get<JointHistory>());
    };
    double energy = stored(moving) - stored(rest) + lost.friction
                    + lost.fracture + lost.crushing + lost.plastic;
    for (unsigned int i = 0; i < model.n_deformable_nodes(); ++i)
      for (const double v : state.velocity[i].v)
        energy += 0.5 * stepper.mass()[i] * v * v;
    state.energy.external += energy;
  }
} // namespace quoin
