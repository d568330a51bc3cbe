// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_triangle_strips_h
#define quoin_blocks_triangle_strips_h

#include <array>
#include <cstddef>
#include <vector>

namespace quoin
{
  /**
   * One node of a strip sequence. With the two nodes before it, it makes the
   * triangle @p cell, or none where a strip begins (twice) or turns about its
   * last node (once).
   */
  struct StripEntry
  {
    static constexpr unsigned int no_cell = static_cast<unsigned int>(-1);

    unsigned int node;
    unsigned int cell;
  };

  struct StripStatistics
  {
    std::size_t n_cells  = 0;
    std::size_t n_strips = 0;
    std::size_t n_turns  = 0;

    double mean_length() const
    {
      return n_strips == 0 ? 0. : static_cast<double>(n_cells) / n_strips;
    }
  };

  /**
   * Covers the triangles @p members of @p cells by strips and returns these
   * one after the other: each entry's node makes a triangle with the previous
   * two, so that a walk along the sequence meets a node about twice and not
   * six times. Each member appears in exactly one entry. The triangle's nodes
   * may come in either orientation.
   *
   * The algorithm is greedy: a strip begins at a cell with the fewest free
   * neighbours, near the previous strip, and takes the longest path. At its end
   * it turns to the longest path of free cells around its last node, if any.
   */
  std::vector<StripEntry>
  make_strips(const std::vector<std::array<unsigned int, 3>> &cells,
              const std::vector<unsigned int> &members,
              StripStatistics *statistics);
} // namespace quoin

#endif
