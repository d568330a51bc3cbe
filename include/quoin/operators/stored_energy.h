// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_stored_energy_h
#define quoin_operators_stored_energy_h

#include <quoin/operators/force_operator.h>

namespace quoin
{
  /** Recoverable energy of this rank's share of @p operators [J]. */
  template <int dim, typename... Operators>
  double stored_energy(const State<dim> &state, const Operators &...operators)
  {
    EnergyAccounts energies;
    (operators.add_stored_energy(state, energies), ...);
    return energies.sum(EnergyKind::stored);
  }
} // namespace quoin

#endif
