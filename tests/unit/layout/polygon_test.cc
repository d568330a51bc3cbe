// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/layout/polygon.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  using Point = dealii::Point<2>;

  /** An L: the unit square without its upper right quarter. */
  const Polygon ell = { Point(0, 0),     Point(1, 0),   Point(1, 0.5),
                        Point(0.5, 0.5), Point(0.5, 1), Point(0, 1) };

  double length(const std::vector<Piece> &pieces)
  {
    double sum = 0.;
    for (const Piece &piece : pieces)
      sum += piece[0].distance(piece[1]);
    return sum;
  }
} // namespace

TEST(Polygon, has_area_and_perimeter)
{
  EXPECT_DOUBLE_EQ(signed_area(ell), 0.75);
  EXPECT_DOUBLE_EQ(perimeter(ell), 4.);
  EXPECT_DOUBLE_EQ(signed_area(Polygon(ell.rbegin(), ell.rend())), -0.75);
}

TEST(Polygon, contains_points)
{
  EXPECT_TRUE(contains(ell, Point(0.25, 0.75)));
  EXPECT_FALSE(contains(ell, Point(0.75, 0.75)));
  EXPECT_FALSE(contains(ell, Point(-0.1, 0.5)));
}

TEST(Polygon, has_a_distance)
{
  EXPECT_DOUBLE_EQ(distance(ell, Point(0.75, 0.7)), 0.2);
  EXPECT_DOUBLE_EQ(distance(ell, Point(0.25, 0.2)), 0.2);
  EXPECT_DOUBLE_EQ(distance(ell, Point(-3., -4.)), 5.);
}

TEST(Polygon, is_simple_or_not)
{
  EXPECT_TRUE(is_simple(ell));
  EXPECT_FALSE(
      is_simple({ Point(0, 0), Point(1, 1), Point(1, 0), Point(0, 1) }));
  // A corner on another side, a spike, a corner twice.
  EXPECT_FALSE(is_simple(
      { Point(0, 0), Point(2, 0), Point(2, 1), Point(1, 0), Point(0, 1) }));
  EXPECT_FALSE(is_simple({ Point(0, 0), Point(2, 0), Point(1, 0) }));
  EXPECT_FALSE(
      is_simple({ Point(0, 0), Point(1, 0), Point(1, 0), Point(0, 1) }));
}

TEST(Polygon, clips_segments)
{
  // Through both arms: inside from 0 to 0.5 of the upper one alone.
  const auto level = clip({ { Point(-1, 0.75), Point(2, 0.75) } }, ell);
  ASSERT_EQ(level.size(), 1u);
  EXPECT_NEAR(length(level), 0.5, 1e-15);
  // From arm to arm through the missing quarter.
  const auto slope = clip({ { Point(0.25, 1), Point(1, 0.25) } }, ell);
  ASSERT_EQ(slope.size(), 2u);
  EXPECT_NEAR(length(slope), 2. * 0.25 * std::sqrt(2.), 1e-14);
  const Piece inside = { { Point(0.1, 0.1), Point(0.2, 0.3) } };
  EXPECT_EQ(clip(inside, ell), std::vector<Piece>{ inside });
  EXPECT_TRUE(clip({ { Point(0.6, 0.6), Point(0.9, 0.9) } }, ell).empty());
}

TEST(Polygon, arch_has_the_area_of_its_parts)
{
  const double pi = M_PI;
  // A half circle on walls; chords take (1 - sinc) of the segment.
  EXPECT_NEAR(signed_area(arch_polygon(Point(1, 2), 6., 3., 3., 400)),
              18. + 4.5 * pi, 1e-3);
  EXPECT_NEAR(signed_area(arch_polygon(Point(1, 2), 6., 0., 3., 400)), 4.5 * pi,
              1e-3);
  // A flat arch: a segment of a circle of radius 5 m.
  const Polygon flat = arch_polygon(Point(1, 2), 6., 3., 1., 400);
  EXPECT_NEAR(signed_area(flat), 18. + 25. * std::acos(0.8) - 12., 1e-3);
  EXPECT_NEAR(bounding_box(flat)[3], 2. + 3. + 1., 1e-12);
  EXPECT_NEAR(signed_area(arch_polygon(Point(0, 0), 4., 2., 0., 10)), 8.,
              1e-12);
  EXPECT_NEAR(signed_area(circle_polygon(Point(3, 4), 2., 6)),
              6. * std::sqrt(3.), 1e-12);
}
