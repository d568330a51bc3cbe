// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_state_checks_h
#define quoin_dynamics_state_checks_h

#include <quoin/model/model.h>

namespace quoin
{
  /** Throws a ModelFailure if a cell is inverted; collective. */
  template <int dim>
  void check_cells(const Model<dim> &model, const State<dim> &state);

  /**
   * The largest slip of a matched joint that bears pressure, by the length of
   * its face [-]: beyond about one half its blocks no longer face each other,
   * and small displacements are no longer valid. Collective.
   */
  double largest_slip_share(const Model<2> &model, const State<2> &state);
} // namespace quoin

#endif
