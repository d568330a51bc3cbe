// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_model_stability_h
#define quoin_model_model_stability_h

#include <quoin/blocks/stable_time_step.h>
#include <quoin/model/model.h>

namespace quoin
{
  /** Bound of the critical step of @p model with the plastic strains of
      @p state; of the blocks alone if joints and contacts are not
      @p with_springs. Collective. */
  template <int dim>
  StableTimeStep<dim> stability_at(const Model<dim> &model,
                                   const State<dim> &state,
                                   bool with_springs = true);
} // namespace quoin

#endif
