// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_segment_h
#define quoin_tdbem_segment_h

#include <Eigen/Core>

#include <algorithm>

namespace quoin
{
  /** Of @p point from the segment from @p a to @p b, not a point [m]. */
  inline double distance_to_segment(const Eigen::Vector2d &point,
                                    const Eigen::Vector2d &a,
                                    const Eigen::Vector2d &b)
  {
    const Eigen::Vector2d edge = b - a;
    const double s
        = std::clamp(edge.dot(point - a) / edge.squaredNorm(), 0., 1.);
    return (point - a - s * edge).norm();
  }
} // namespace quoin

#endif
