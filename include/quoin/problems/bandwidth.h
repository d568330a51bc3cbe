// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_bandwidth_h
#define quoin_problems_bandwidth_h

namespace quoin
{
  /**
   * Memory bandwidth that this rank gets, by the triad a = b + c * s over
   * arrays beyond any cache; best of several runs [B/s].
   */
  double memory_bandwidth();

  /**
   * Bytes that one undamped step must move to and from memory if each array
   * is streamed once: node records, velocities, forces, masses, and the node
   * number that each cell adds to its strip.
   */
  double step_bytes(double n_nodes, double n_cells);
} // namespace quoin

#endif
