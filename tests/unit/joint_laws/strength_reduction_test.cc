// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "composite_walk.h"
#include "rock_walk.h"

#include <quoin/joint_laws/joint_law.h>

using namespace quoin;

namespace
{
  constexpr double factor = 1.6;

  template <typename Law>
  Law weaker(const Law &law, const double by)
  {
    return std::get<Law>(reduced(law, by));
  }
} // namespace

TEST(StrengthReduction, CoulombJoint)
{
  CoulombLaw law;
  law.normal_stiffness  = 8e9;
  law.shear_stiffness   = 3e9;
  law.peak              = { 1e6, 0.8, 0.4e6 };
  law.residual          = { 0.2e6, 0.6, 0.1e6 };
  law.dilation          = 0.55;
  const CoulombLaw weak = weaker(law, factor);
  EXPECT_EQ(weak.normal_stiffness, 8e9);
  EXPECT_EQ(weak.shear_stiffness, 3e9);
  EXPECT_DOUBLE_EQ(weak.peak.cohesion, 1e6 / factor);
  EXPECT_DOUBLE_EQ(weak.peak.friction, 0.5);
  EXPECT_DOUBLE_EQ(weak.peak.tension, 0.25e6);
  EXPECT_DOUBLE_EQ(weak.residual.cohesion, 0.2e6 / factor);
  EXPECT_DOUBLE_EQ(weak.residual.friction, 0.375);
  EXPECT_DOUBLE_EQ(weak.residual.tension, 0.1e6 / factor);
  EXPECT_DOUBLE_EQ(weak.dilation, 0.375); // not above residual friction
  EXPECT_DOUBLE_EQ(weaker(law, 1.).dilation, 0.55);
}

TEST(StrengthReduction, ElasticJointHasNoStrengthToReduce)
{
  const CoulombLaw weak = weaker(CoulombLaw(), factor);
  EXPECT_EQ(weak.peak.cohesion, CompositeLaw::infinity);
  EXPECT_EQ(weak.peak.tension, CompositeLaw::infinity);
}

TEST(StrengthReduction, CompositeJointKeepsItsEnergiesAndItsCap)
{
  CompositeLaw strong     = composite_test::dilatant();
  strong.dilation         = 0.59;
  const CompositeLaw weak = weaker(strong, factor);
  EXPECT_DOUBLE_EQ(weak.tension, strong.tension / factor);
  EXPECT_DOUBLE_EQ(weak.cohesion, strong.cohesion / factor);
  EXPECT_DOUBLE_EQ(weak.friction, strong.friction / factor);
  EXPECT_DOUBLE_EQ(weak.residual_friction, strong.residual_friction / factor);
  EXPECT_DOUBLE_EQ(weak.dilation, 0.6 / factor);
  EXPECT_EQ(weak.tension_energy, strong.tension_energy);
  EXPECT_EQ(weak.shear_energy, strong.shear_energy);
  EXPECT_EQ(weak.cap.compression, strong.cap.compression);
  EXPECT_EQ(weak.normal_stiffness, strong.normal_stiffness);
}

TEST(StrengthReduction, BartonBandisJointHasItsEnvelopeDivided)
{
  const auto weak   = weaker(weaker(rock_test::rough(), factor), 1.25);
  const auto strong = rock_test::rough();
  for (const double s : { 1e3, 1e6, 1e7, 2e8 })
    for (const double slip : { 1e-4, 5e-4, 1e-3, 8e-3, 0.2 })
    {
      double psi, expected_psi;
      const double strength = weak.strength(s, slip, psi);
      EXPECT_NEAR(strength, strong.strength(s, slip, expected_psi) / 2.,
                  1e-12 * s);
      EXPECT_LE(psi, std::min(expected_psi, strength / s) + 1e-15);
    }
  // No energy comes from dilation, however weak the joint.
  const auto walk = rock_test::random_walk(weaker(strong, 6.), 200);
  EXPECT_GT(walk.least, -1e-9);
}

TEST(StrengthReduction, ContinuouslyYieldingJoint)
{
  const auto strong = rock_test::yielding();
  const auto weak   = weaker(strong, factor);
  EXPECT_DOUBLE_EQ(std::tan(weak.initial_angle),
                   std::tan(strong.initial_angle) / factor);
  EXPECT_DOUBLE_EQ(std::tan(weak.residual_angle),
                   std::tan(strong.residual_angle) / factor);
  EXPECT_EQ(weak.roughness, strong.roughness);
  auto walk = rock_test::closed(weak, -2e6);
  walk.slide(-2e6, 2e-2, 2000);
  EXPECT_NEAR(walk.point.shear_traction,
              2e6 * std::tan(strong.residual_angle) / factor, 10.);
}
