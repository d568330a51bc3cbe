// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/plane_geometry.h>

#include <gtest/gtest.h>

using namespace quoin;
using Point = dealii::Point<2>;

TEST(PlaneGeometry, LeftIsPositive)
{
  EXPECT_EQ(cross(Point(2., 0.), Point(0., 3.)), 6.);
  EXPECT_EQ(twice_area(Point(1., 1.), Point(3., 1.), Point(0., 4.)), 6.);
  EXPECT_EQ(twice_area(Point(1., 1.), Point(3., 1.), Point(0., -2.)), -6.);
}

TEST(PlaneGeometry, SegmentsEndAtTheirEnds)
{
  const Point a(1., 1.), b(5., 1.);
  EXPECT_EQ(distance_to_segment(Point(2., 3.), a, b), 2.);
  EXPECT_EQ(distance_to_segment(Point(-2., 5.), a, b), 5.);
  EXPECT_EQ(distance_to_segment(Point(8., -3.), a, b), 5.);
  EXPECT_EQ(distance_to_segment(Point(4., 5.), a, a), 5.);
}

TEST(PlaneGeometry, EndsOfASegmentLieOnIt)
{
  // 7.6 + (2.6 - 7.6) is not 2.6.
  const Point a(7.6, 0.), b(2.6, 0.);
  EXPECT_EQ(distance_to_segment(a, a, b), 0.);
  EXPECT_EQ(distance_to_segment(b, a, b), 0.);
}
