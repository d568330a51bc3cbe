// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"
#include "rock_walk.h"

#include <quoin/joint_laws/joint_parameters.h>

using namespace quoin;

namespace
{
  constexpr double degree = 3.14159265358979323846 / 180.;

  const std::string barton_bandis = "set Law = Barton-Bandis\n"
                                    "set Normal stiffness = 10e9\n"
                                    "set Largest closure = 0.3e-3\n"
                                    "set Shear stiffness = 5e9\n"
                                    "set Joint roughness = 10\n"
                                    "set Joint wall strength = 100e6\n"
                                    "set Residual friction angle = 28\n"
                                    "set Joint length = 2\n";

  const std::string yielding = "set Law = continuously yielding\n"
                               "set Normal stiffness = 20e9\n"
                               "set Normal exponent = 0.5\n"
                               "set Shear stiffness = 8e9\n"
                               "set Shear exponent = 0.4\n"
                               "set Friction angle = 50\n"
                               "set Residual friction angle = 30\n"
                               "set Roughness = 1e-3\n";

  JointSetParameters read(const std::string &text)
  {
    return read_named_section<JointSetParameters>("bed", text);
  }

  void expect_refused(const std::string &text, const std::string &setting,
                      const std::string &why)
  {
    expect_section_refused("bed", setting + " = ", why, [&] { read(text); });
  }
} // namespace

TEST(RockLaws, BartonBandis)
{
  const JointSetParameters set = read(barton_bandis);
  const auto &law              = std::get<BartonBandisLaw>(set.law);
  EXPECT_NEAR(law.closure.traction(0.15e-3), 3e6, 1e-6);
  EXPECT_EQ(law.stiffness, 5e9);
  EXPECT_DOUBLE_EQ(law.roughness, 10. * degree);
  EXPECT_EQ(law.wall_strength, 100e6);
  EXPECT_DOUBLE_EQ(law.residual_angle, 28. * degree);
  EXPECT_NEAR(law.peak_slip, 2. / 500. * std::pow(5., 0.33), 1e-12);
  EXPECT_EQ(law.divisor, 1.);
  // What the time step needs to know
  EXPECT_EQ(stiffness_bound(law), (std::array<double, 2>{ 250e9, 5e9 }));

  const auto other
      = read(barton_bandis
             + "set Peak slip = 3e-3\nset Largest normal stiffness = 80e9\n");
  EXPECT_EQ(std::get<BartonBandisLaw>(other.law).peak_slip, 3e-3);
  EXPECT_EQ(stiffness_bound(other.law)[0], 80e9);
}

TEST(RockLaws, RoughnessAndWallStrengthOfALongJoint)
{
  const auto set  = read(barton_bandis + "set Laboratory length = 0.1\n");
  const auto &law = std::get<BartonBandisLaw>(set.law);
  const double roughness = 10. * std::pow(20., -0.2);
  EXPECT_NEAR(law.roughness, roughness * degree, 1e-12);
  EXPECT_NEAR(law.wall_strength, 100e6 * std::pow(20., -0.3), 1.);
  EXPECT_NEAR(law.peak_slip, 2. / 500. * std::pow(roughness / 2., 0.33), 1e-12);
}

TEST(RockLaws, ContinuouslyYielding)
{
  const JointSetParameters set = read(yielding);
  const auto &law              = std::get<ContinuouslyYieldingLaw>(set.law);
  EXPECT_NEAR(law.closure.stiffness(1e6), 20e9, 1.);
  EXPECT_NEAR(law.closure.stiffness(4e6), 40e9, 1.);
  EXPECT_NEAR(law.shear_stiffness(4e6), 8e9 * std::pow(4., 0.4), 1.);
  EXPECT_DOUBLE_EQ(law.initial_angle, 50. * degree);
  EXPECT_DOUBLE_EQ(law.residual_angle, 30. * degree);
  EXPECT_EQ(law.roughness, 1e-3);
  EXPECT_NEAR(stiffness_bound(law)[0], 200e9, 1.);
  EXPECT_NEAR(stiffness_bound(law)[1], 8e9 * std::pow(100., 0.4), 1.);
}

TEST(RockLaws, RefusesWhatMakesNoSense)
{
  for (const std::string &law : { barton_bandis, yielding })
  {
    expect_refused(law + "set Cohesion = 1e5\n", "Cohesion", "Coulomb");
    expect_refused(law + "set Tensile strength = 1e5\n", "Tensile strength",
                   "Coulomb");
    expect_refused(law + "set Dilation angle = 5\n", "Dilation angle",
                   "follows");
    expect_refused(law + "set Normal stiffness = 0\n", "Normal stiffness",
                   "positive");
    expect_refused(law + "set Shear stiffness = -1\n", "Shear stiffness",
                   "positive");
    expect_refused(law + "set Residual friction angle = same\n",
                   "Residual friction angle", "given");
    expect_refused(law + "set Residual friction angle = 0\n",
                   "Residual friction angle", "between 0 and 70");
  }
  expect_refused(barton_bandis + "set Largest closure = 0\n", "Largest closure",
                 "positive");
  expect_refused(barton_bandis + "set Largest normal stiffness = 5e9\n",
                 "Largest normal stiffness", "Normal stiffness");
  expect_refused(barton_bandis + "set Joint roughness = 40\n",
                 "Joint roughness", "30");
  expect_refused(barton_bandis + "set Joint wall strength = 0\n",
                 "Joint wall strength", "positive");
  expect_refused(barton_bandis + "set Joint length = 0\n", "Peak slip",
                 "Joint length");
  expect_refused(barton_bandis + "set Laboratory length = 3\n", "Joint length",
                 "Laboratory length");
  expect_refused(yielding + "set Roughness = 0\n", "Roughness", "positive");
  expect_refused(yielding + "set Normal exponent = 1.5\n", "Normal exponent",
                 "1");
  expect_refused(yielding + "set Shear exponent = -1\n", "Shear exponent", "0");
  expect_refused(yielding + "set Friction angle = 20\n", "Friction angle",
                 "worn");
  expect_refused(yielding + "set Highest stress = 1e3\n", "Highest stress",
                 "Lowest stress");
}

// The elastic one, or no load could be put on an unstressed model.
TEST(RockLaws, TangentOfAJointWithoutPressure)
{
  const auto check = [](const auto &law)
  {
    RockPoint<2> point;
    JointTangent<2> tangent;
    law.update(point, 0., 0., tangent);
    const auto [kn, ks] = law.stiffness_at(0.);
    EXPECT_NEAR(tangent.normal_opening, kn, 1e-9 * kn);
    EXPECT_NEAR(tangent.shear_slip, ks, 1e-9 * ks);
  };
  check(rock_test::rough());
  check(rock_test::yielding());
}
