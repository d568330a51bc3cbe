// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_block_gaps_h
#define quoin_contact_block_gaps_h

#include <quoin/operators/state.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  /**
   * The gap of each block that has one, ascending [m]: its distance at the
   * positions of @p state from the nearest block that it does not touch, if
   * that is less than @p reach [m]. Blocks nearer than 1e-5 of @p reach, and
   * those with a joint between them, touch. In large models the gap is not
   * looked for beyond some edges. Collective.
   */
  std::vector<double> block_gaps(const NodeMap<2> &nodes, const State<2> &state,
                                 double reach);
} // namespace quoin

#endif
