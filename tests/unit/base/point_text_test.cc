// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/point_text.h>

#include <deal.II/base/point.h>

#include <gtest/gtest.h>

#include <limits>

using namespace quoin;

TEST(PointText, HasSixDigitsAndMillimetresOfMaps)
{
  EXPECT_EQ(point_text(dealii::Point<2>(1., 2.)), "(1, 2)");
  EXPECT_EQ(point_text(dealii::Point<2>(1. / 3., -1e-9)), "(0.333333, -1e-09)");
  EXPECT_EQ(point_text(dealii::Point<3>(512345.6784, 4212345.6, 12.34)),
            "(512345.6784, 4212345.6, 12.34)");
  EXPECT_EQ(point_text(
                dealii::Point<2>(std::numeric_limits<double>::quiet_NaN(), 1.)),
            "(nan, 1)");
}
