// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/in_situ_stress.h>

#include <gtest/gtest.h>

#include <limits>

using namespace quoin;

namespace
{
  constexpr double lowest = -std::numeric_limits<double>::infinity();

  /** Level ground at 2 m, on the right at 6 m, a slope in between. */
  InSituStress slope()
  {
    InSituStress result;
    result.surface            = { { { 10., 2. } }, { { 18., 6. } } };
    result.layers             = { { 20e3, -1. }, { 25e3, lowest } };
    result.pressure           = InSituStress::uniform(3e3);
    result.horizontal_ratio   = InSituStress::uniform(0.5);
    result.horizontal_stress  = InSituStress::uniform(-7e3);
    result.out_of_plane_ratio = InSituStress::uniform(0.4);
    return result;
  }
} // namespace

TEST(InSituStress, SurfaceIsLevelBeyondItsEnds)
{
  const InSituStress ground = slope();
  EXPECT_EQ(ground.surface_height({ -5., 0., 0. }), 2.);
  EXPECT_EQ(ground.surface_height({ 10., 0., 0. }), 2.);
  EXPECT_DOUBLE_EQ(ground.surface_height({ 12., 0., 0. }), 3.);
  EXPECT_EQ(ground.surface_height({ 18., 0., 0. }), 6.);
  EXPECT_EQ(ground.surface_height({ 40., 0., 0. }), 6.);
}

TEST(InSituStress, IsTheWeightAbove)
{
  const InSituStress ground = slope();
  // 4 m of the upper layer and 3 m of the lower one
  const double vertical = -(3e3 + 4. * 20e3 + 3. * 25e3);
  const auto stress     = ground.stress(12., -4.);
  EXPECT_DOUBLE_EQ(stress[1], vertical);
  EXPECT_DOUBLE_EQ(stress[0], 0.5 * vertical - 7e3);
  EXPECT_EQ(stress[2], 0.);
  EXPECT_DOUBLE_EQ(stress[3], 0.4 * vertical);
  // in the upper layer, on the surface and above it
  EXPECT_DOUBLE_EQ(ground.stress(30., 1.)[1], -(3e3 + 5. * 20e3));
  EXPECT_DOUBLE_EQ(ground.stress(30., 6.)[1], -3e3);
  for (const double component : ground.stress(30., 6.5))
    EXPECT_EQ(component, 0.);
}

TEST(InSituStress, HasHeightsAlongZInSpace)
{
  InSituStress ground = slope();
  const auto plane    = ground.stress(12., -4.);
  const auto space    = ground.normal_stress({ 12., 7., -4. }, 2);
  EXPECT_EQ(space[0], plane[0]);
  EXPECT_EQ(space[1], plane[1]);
  EXPECT_EQ(space[2], plane[3]);
  ground.surface_function = [](const dealii::Point<3> &p) { return p[1] - 1.; };
  EXPECT_DOUBLE_EQ(ground.normal_stress({ 12., 7., 4. }, 2)[1],
                   -(3e3 + 2. * 20e3));
}

TEST(InSituStress, FollowsFunctionsOfThePlace)
{
  InSituStress ground = slope();
  ground.surface_function
      = [](const dealii::Point<3> &p) { return p[0] < 14. ? 2. : 6.; };
  ground.pressure = [](const dealii::Point<3> &p) { return 100. * p[0]; };
  ground.horizontal_ratio
      = [](const dealii::Point<3> &p) { return 0.5 - 0.1 * p[1]; };
  ground.horizontal_stress
      = [](const dealii::Point<3> &p) { return p[0] * p[1]; };
  EXPECT_EQ(ground.surface_height({ 13., 0., 0. }), 2.);
  EXPECT_EQ(ground.surface_height({ 15., 0., 0. }), 6.);
  // 3 m of the upper layer and 3 m of the lower one, left of the step
  const double vertical = -(1.2e3 + 3. * 20e3 + 3. * 25e3);
  const auto stress     = ground.stress(12., -4.);
  EXPECT_DOUBLE_EQ(stress[1], vertical);
  EXPECT_DOUBLE_EQ(stress[0], 0.9 * vertical - 48.);
  EXPECT_DOUBLE_EQ(stress[3], 0.4 * vertical);
  EXPECT_DOUBLE_EQ(ground.stress(15., 1.)[1], -(1.5e3 + 5. * 20e3));
}
