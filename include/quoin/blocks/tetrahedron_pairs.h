// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_tetrahedron_pairs_h
#define quoin_blocks_tetrahedron_pairs_h

#include <array>
#include <cstddef>
#include <vector>

/** Tetrahedra that share a face, two by two. */
namespace quoin
{
  /** One or two tetrahedra. The first has nodes 0, 1, 2, 3, the second 0, 2,
      1, 4; the volumes of both have the sign that they have as cells. */
  struct TetrahedronCluster
  {
    std::array<unsigned int, 5> nodes;
    std::array<unsigned int, 2> cells; /**< indices */
  };

  struct TetrahedronPairs
  {
    std::vector<TetrahedronCluster> pairs;
    std::vector<TetrahedronCluster> singles; /**< without a second cell */
  };

  /** Pairs as many of the @p cells as an order of few neighbours first finds,
      which is nearly all of a compact mesh; only cells of the same @p n_joined
      ones that follow one another. Pairs and singles are sorted by their first
      cell. */
  TetrahedronPairs
  pair_tetrahedra(const std::vector<std::array<unsigned int, 4>> &cells,
                  std::size_t n_joined);
} // namespace quoin

#endif
