// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_polygon_h
#define quoin_layout_polygon_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Corners of a simple polygon, in order; the last is joined to the first. */
  using Polygon = std::vector<dealii::Point<2>>;

  /** Positive if the corners run counter-clockwise [m^2]. */
  double signed_area(const Polygon &polygon);

  double perimeter(const Polygon &polygon);

  /** Whether @p point is inside; on the edge either may be the answer. */
  bool contains(const Polygon &polygon, const dealii::Point<2> &point);

  /** Distance of @p point from the nearest side [m]. */
  double distance(const Polygon &polygon, const dealii::Point<2> &point);

  /** xmin, ymin, xmax, ymax. */
  std::array<double, 4> bounding_box(const Polygon &polygon);

  /** Whether no two edges cross or touch but at common corners. */
  bool is_simple(const Polygon &polygon);

  using Piece = std::array<dealii::Point<2>, 2>;

  /** The parts of the segment @p piece inside of @p polygon, in order. */
  std::vector<Piece> clip(const Piece &piece, const Polygon &polygon);

  /** Polygon of @p n corners on a circle, the first one at angle 0. */
  Polygon circle_polygon(const dealii::Point<2> &centre, double radius,
                         unsigned int n);

  /**
   * The section of a tunnel: floor, walls and a roof that is an arc of a
   * circle, in @p n chords. @p floor: the middle of its floor; @p rise of the
   * roof above the walls, at most half of the width [m].
   */
  Polygon arch_polygon(const dealii::Point<2> &floor, double width,
                       double wall_height, double rise, unsigned int n);
} // namespace quoin

#endif
