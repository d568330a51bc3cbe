// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_initial_energy_h
#define quoin_dynamics_initial_energy_h

#include <quoin/model/model.h>

namespace quoin
{
  /** Throws an InputError if section 'Initial motion', by which @p state moves,
      moves a rigid block; collective. */
  template <int dim>
  void refuse_moved_rigid_blocks(const Model<dim> &model,
                                 const State<dim> &state);

  /**
   * Books the energy of @p state, which is in motion at the start of the run,
   * before the first stage, as external work.
   */
  template <int dim>
  void account_for_initial_motion(const Model<dim> &model, State<dim> &state);
} // namespace quoin

#endif
