// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_segment_group_h
#define quoin_joint_elements_segment_group_h

#include <quoin/base/native_lanes.h>

#include <cstdint>

namespace quoin
{
  /**
   * Segments of matched joints that are computed together, one in each SIMD
   * lane. Lanes without a segment repeat the nodes of the last one and have no
   * area.
   */
  template <int lanes>
  struct SegmentGroup
  {
    /** Offsets in arrays of dealii::Tensor<1, 2> [B] of lower[0], lower[1],
       upper[0], upper[1]; in those of NodeRecord<2> they are twice as large. */
    std::uint32_t nodes[4][lanes];
    /** Area of each point, in the order of the history [m^2]. */
    double area[2 * lanes];
    /** Area times the share of the energy that this rank counts [m^2]. */
    double weight[2 * lanes];
    std::uint32_t first; /**< index of the first segment */
    std::uint32_t size;  /**< number of segments */
  };
} // namespace quoin

#endif
