// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/layout/polygon.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  using Point = dealii::Point<2>;

  double signed_area(const Polygon &polygon)
  {
    // About the first corner, which keeps digits far from the origin.
    double twice = 0.;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return 0.5 * twice;
  }

  double perimeter(const Polygon &polygon)
  {
    double length = 0.;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      length += polygon[i].distance(polygon[(i + 1) % polygon.size()]);
    return length;
  }

  bool contains(const Polygon &polygon, const Point &point)
  {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a[1] > point[1]) != (b[1] > point[1])
          && point[0]
                 < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
        inside = !inside;
    }
    return inside;
  }

  double distance(const Polygon &polygon, const Point &point)
  {
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < polygon.size(); ++i)
      nearest = std::min(
          nearest, distance_to_segment(point, polygon[i],
                                       polygon[(i + 1) % polygon.size()]));
    return nearest;
  }

  std::array<double, 4> bounding_box(const Polygon &polygon)
  {
    std::array<double, 4> box
        = { polygon[0][0], polygon[0][1], polygon[0][0], polygon[0][1] };
    for (const Point &p : polygon)
      for (unsigned int d = 0; d < p.dimension; ++d)
      {
        box[d]     = std::min(box[d], p[d]);
        box[2 + d] = std::max(box[2 + d], p[d]);
      }
    return box;
  }

  namespace
  {
    bool is_on(const Point &a, const Point &b, const Point &p)
    {
      return twice_area(a, b, p) == 0. && (p - a) * (p - b) <= 0.;
    }

    bool meet(const Point &a, const Point &b, const Point &c, const Point &d)
    {
      return (twice_area(a, b, c) * twice_area(a, b, d) < 0.
              && twice_area(c, d, a) * twice_area(c, d, b) < 0.)
             || is_on(a, b, c) || is_on(a, b, d) || is_on(c, d, a)
             || is_on(c, d, b);
    }
  } // namespace

  bool is_simple(const Polygon &polygon)
  {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      const Point &a = polygon[i], &b = polygon[(i + 1) % n];
      // Next edges share a corner: they must not turn back on each other.
      if (a == b || is_on(a, b, polygon[(i + 2) % n]))
        return false;
      for (std::size_t j = i + 2; j < n; ++j)
        if ((j + 1) % n != i && meet(a, b, polygon[j], polygon[(j + 1) % n]))
          return false;
    }
    return n >= 3;
  }

  std::vector<Piece> clip(const Piece &piece, const Polygon &polygon)
  {
    const auto direction      = piece[1] - piece[0];
    std::vector<double> where = { 0., 1. };
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Point &a      = polygon[i];
      const auto edge     = polygon[(i + 1) % polygon.size()] - a;
      const double across = direction[0] * edge[1] - direction[1] * edge[0];
      if (across == 0.)
        continue;
      const auto to  = a - piece[0];
      const double t = (to[0] * edge[1] - to[1] * edge[0]) / across;
      const double s = (to[0] * direction[1] - to[1] * direction[0]) / across;
      if (0. < t && t < 1. && 0. <= s && s <= 1.)
        where.push_back(t);
    }
    std::sort(where.begin(), where.end());

    std::vector<Piece> inside;
    bool goes_on = false;
    for (std::size_t i = 0; i + 1 < where.size(); ++i)
    {
      const bool is_inside = contains(
          polygon, piece[0] + 0.5 * (where[i] + where[i + 1]) * direction);
      const Point end = i + 2 == where.size()
                            ? piece[1]
                            : piece[0] + where[i + 1] * direction;
      if (is_inside && goes_on)
        inside.back()[1] = end;
      else if (is_inside)
        inside.push_back(
            { { i == 0 ? piece[0] : piece[0] + where[i] * direction, end } });
      goes_on = is_inside;
    }
    return inside;
  }

  Polygon circle_polygon(const Point &centre, const double radius,
                         const unsigned int n)
  {
    Polygon polygon;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double angle = 2. * constants::pi * i / n;
      polygon.emplace_back(centre[0] + radius * std::cos(angle),
                           centre[1] + radius * std::sin(angle));
    }
    return polygon;
  }

  Polygon arch_polygon(const Point &floor, const double width,
                       const double wall_height, const double rise,
                       const unsigned int n)
  {
    const double half = 0.5 * width;
    Polygon polygon   = { Point(floor[0] - half, floor[1]),
                          Point(floor[0] + half, floor[1]) };
    if (rise == 0.)
    {
      polygon.emplace_back(floor[0] + half, floor[1] + wall_height);
      polygon.emplace_back(floor[0] - half, floor[1] + wall_height);
      return polygon;
    }
    const double radius = 0.5 * (half * half + rise * rise) / rise;
    const double centre = floor[1] + wall_height + rise - radius;
    const double reach  = std::asin(std::min(1., half / radius));
    for (unsigned int i = 0; i <= n; ++i)
    {
      const double angle = reach * (1. - 2. * i / n);
      // Without walls the roof springs from the floor itself.
      if (wall_height == 0. && (i == 0 || i == n))
        continue;
      polygon.emplace_back(floor[0] + radius * std::sin(angle),
                           centre + radius * std::cos(angle));
    }
    return polygon;
  }
} // namespace quoin
