// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_model_changes_h
#define quoin_model_model_changes_h

#include <quoin/model/model.h>

#include <vector>

namespace quoin
{
  /** Model::set_properties() which keeps the stresses and tractions of
      @p state. Collective. */
  template <int dim>
  void change_properties(Model<dim> &model, const ModelProperties &properties,
                         State<dim> &state);

  /** Sets the stress at zero strain of the cells of @p groups to zero. */
  template <int dim>
  void clear_initial_stress(const Model<dim> &model,
                            const std::vector<bool> &groups,
                            ConstructionState<dim> &construction);
} // namespace quoin

#endif
