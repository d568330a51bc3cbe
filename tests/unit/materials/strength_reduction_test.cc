// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/materials/material_parameters.h>

#include <gtest/gtest.h>

using namespace quoin;

TEST(MaterialStrengthReduction, DividesStrengthAndNothingElse)
{
  MaterialParameters rock;
  rock.name    = "rock";
  rock.elastic = { 2700., 50e9, 0.25 };
  rock.strength
      = MohrCoulombStrength{ 2e6, std::atan(0.8), std::atan(0.7), 1e6 };
  const MaterialParameters weak = reduced(rock, 1.6);
  EXPECT_EQ(weak.name, "rock");
  EXPECT_EQ(weak.elastic.young, 50e9);
  EXPECT_DOUBLE_EQ(weak.strength->cohesion, 1.25e6);
  EXPECT_DOUBLE_EQ(std::tan(weak.strength->friction_angle), 0.5);
  EXPECT_DOUBLE_EQ(weak.strength->tension, 0.625e6);
  EXPECT_DOUBLE_EQ(std::tan(weak.strength->dilation_angle), 0.5);
  rock.strength->dilation_angle = std::atan(0.3);
  EXPECT_DOUBLE_EQ(std::tan(reduced(rock, 1.6).strength->dilation_angle), 0.3);
}

TEST(MaterialStrengthReduction, TheTipOfTheConeComesDownToo)
{
  MaterialParameters rock;
  rock.strength = MohrCoulombStrength{ 2e6, std::atan(0.8), 0. };
  EXPECT_DOUBLE_EQ(reduced(rock, 2.).strength->tension, 1.25e6);
  rock.strength->friction_angle = 0.;
  EXPECT_TRUE(std::isinf(reduced(rock, 2.).strength->tension));
  EXPECT_FALSE(reduced(MaterialParameters(), 2.).strength);
}
