// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_free_bodies_h
#define quoin_dynamics_free_bodies_h

#include <quoin/dynamics/model.h>
#include <quoin/loads/node_constraint.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Throws an InputError naming the first body, blocks that joints tie
   * together, which the prescribed freedoms of @p constraints leave free to
   * translate or rotate: it could never come to rest. Blocks that are absent in
   * @p state do not count. @p stage is for the message. Collective.
   */
  void check_no_free_bodies(const Model &model,
                            const std::vector<NodeConstraint *> &constraints,
                            const std::string &stage, const State &state);
} // namespace quoin

#endif
