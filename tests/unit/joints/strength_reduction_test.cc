// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "composite_walk.h"
#include "rock_walk.h"

#include <quoin/joints/joint_parameters.h>

using namespace quoin;

namespace
{
  constexpr double factor = 1.6;
}

TEST(StrengthReduction, CoulombJoint)
{
  JointSetParameters set;
  set.name                      = "bed";
  set.law.normal_stiffness      = 8e9;
  set.law.shear_stiffness       = 3e9;
  set.law.peak                  = { 1e6, 0.8, 0.4e6 };
  set.law.residual              = { 0.2e6, 0.6, 0.1e6 };
  set.law.dilation              = 0.55;
  const JointSetParameters weak = reduced(set, factor);
  EXPECT_EQ(weak.name, "bed");
  EXPECT_EQ(weak.law.normal_stiffness, 8e9);
  EXPECT_EQ(weak.law.shear_stiffness, 3e9);
  EXPECT_DOUBLE_EQ(weak.law.peak.cohesion, 1e6 / factor);
  EXPECT_DOUBLE_EQ(weak.law.peak.friction, 0.5);
  EXPECT_DOUBLE_EQ(weak.law.peak.tension, 0.25e6);
  EXPECT_DOUBLE_EQ(weak.law.residual.cohesion, 0.2e6 / factor);
  EXPECT_DOUBLE_EQ(weak.law.residual.friction, 0.375);
  EXPECT_DOUBLE_EQ(weak.law.residual.tension, 0.1e6 / factor);
  EXPECT_DOUBLE_EQ(weak.law.dilation, 0.375); // not above residual friction
  EXPECT_DOUBLE_EQ(reduced(set, 1.).law.dilation, 0.55);
}

TEST(StrengthReduction, ElasticJointHasNoStrengthToReduce)
{
  const JointSetParameters weak = reduced(JointSetParameters(), factor);
  EXPECT_EQ(weak.law.peak.cohesion, CompositeLaw::infinity);
  EXPECT_EQ(weak.law.peak.tension, CompositeLaw::infinity);
  EXPECT_FALSE(weak.composite || weak.rock);
}

TEST(StrengthReduction, CompositeJointKeepsItsEnergiesAndItsCap)
{
  JointSetParameters set;
  set.composite                 = composite_test::dilatant();
  set.composite->dilation       = 0.59;
  const CompositeLaw &strong    = *set.composite;
  const JointSetParameters less = reduced(set, factor);
  const CompositeLaw &weak      = *less.composite;
  EXPECT_DOUBLE_EQ(weak.tension, strong.tension / factor);
  EXPECT_DOUBLE_EQ(weak.cohesion, strong.cohesion / factor);
  EXPECT_DOUBLE_EQ(weak.friction, strong.friction / factor);
  EXPECT_DOUBLE_EQ(weak.residual_friction, strong.residual_friction / factor);
  EXPECT_DOUBLE_EQ(weak.dilation, 0.6 / factor);
  EXPECT_EQ(weak.tension_energy, strong.tension_energy);
  EXPECT_EQ(weak.shear_energy, strong.shear_energy);
  EXPECT_EQ(weak.compression, strong.compression);
  EXPECT_EQ(weak.normal_stiffness, strong.normal_stiffness);
}

TEST(StrengthReduction, BartonBandisJointHasItsEnvelopeDivided)
{
  JointSetParameters set;
  set.rock          = rock_test::rough();
  const auto twice  = reduced(reduced(set, factor), 1.25);
  const auto &weak  = std::get<BartonBandisLaw>(*twice.rock);
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
  const auto walk = rock_test::random_walk(reduced(strong, 6.), 200);
  EXPECT_GT(walk.least, -1e-9);
}

TEST(StrengthReduction, ContinuouslyYieldingJoint)
{
  const auto strong = rock_test::yielding();
  const auto weak   = reduced(strong, factor);
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
