// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_worst_place_h
#define quoin_implicit_worst_place_h

#include <quoin/implicit/equilibrium.h>

#include <string>
#include <vector>

namespace quoin
{
  /** "in block 3 at (1, 2) m", where the unbalanced force of @p balance is the
      largest, and the joint there; @p set_names: of the sets of joints.
      Collective. */
  template <int dim>
  std::string worst_place(const Model<dim> &model, const DofMap<dim> &dof_map,
                          const Balance<dim> &balance,
                          const std::vector<std::string> &set_names);
} // namespace quoin

#endif
