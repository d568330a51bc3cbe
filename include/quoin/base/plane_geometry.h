// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_plane_geometry_h
#define quoin_base_plane_geometry_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  /** Positive if @p b is to the left of @p a. */
  inline double cross(const dealii::Tensor<1, 2> &a,
                      const dealii::Tensor<1, 2> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }

  /**
   * Twice the area of the triangle [m^2], positive if it is counter-clockwise,
   * that is, if @p p is on the left of the line from @p a to @p b.
   */
  inline double twice_area(const dealii::Point<2> &a, const dealii::Point<2> &b,
                           const dealii::Point<2> &p)
  {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  }

  /**
   * Distance of @p p from the segment, which may be a point [m]; exactly zero
   * at its ends. A Vector has components [0] and [1].
   */
  template <typename Vector>
  double distance_to_segment(const Vector &p, const Vector &a, const Vector &b)
  {
    const double way[2] = { b[0] - a[0], b[1] - a[1] };
    const double arm[2] = { p[0] - a[0], p[1] - a[1] };
    const double square = way[0] * way[0] + way[1] * way[1];
    const double t      = std::clamp(
             (arm[0] * way[0] + arm[1] * way[1]) / std::max(square, 1e-300), 0., 1.);
    return std::hypot(arm[0] - t * way[0], arm[1] - t * way[1]);
  }
} // namespace quoin

#endif
