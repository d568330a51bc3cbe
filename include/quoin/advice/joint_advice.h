// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_joint_advice_h
#define quoin_advice_joint_advice_h

#include <quoin/advice/advice.h>

namespace quoin
{
  /** Warns of sets of joints that are nowhere, and of joints that are too stiff
      or too soft for the blocks beside them. Collective. */
  template <int dim>
  void check_joints(const Parameters &parameters, const Model<dim> &model,
                    Advice &advice);
} // namespace quoin

#endif
