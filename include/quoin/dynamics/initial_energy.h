// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_initial_energy_h
#define quoin_dynamics_initial_energy_h

#include <quoin/model/model.h>

namespace quoin
{
  /**
   * Books the energy of @p state, which is in motion at the start of the run,
   * before the first stage, as external work. Throws an InputError if rigid
   * blocks move; collective.
   */
  template <int dim>
  void account_for_initial_motion(const Model<dim> &model, State<dim> &state);
} // namespace quoin

#endif
