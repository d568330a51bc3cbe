// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_bandwidth_h
#define quoin_problems_bandwidth_h

namespace quoin
{
  /**
   * Bandwidth [B/s] that this rank gets where it streams @p bytes, by the
   * update a = a + s b, which reads both arrays and writes one; best of half a
   * second. So many bytes come from where those of a step do, memory or a
   * cache.
   */
  double memory_bandwidth(double bytes);

  /**
   * Bytes that one undamped step must move to and from memory if each array
   * is streamed once: node records, velocities, forces, masses, and the node
   * number that each cell adds to its strip.
   */
  double step_bytes(double n_nodes, double n_cells);
} // namespace quoin

#endif
