// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"

#include <quoin/joint_laws/joint_parameters.h>

#include <cmath>

using namespace quoin;

namespace
{
  const std::string stiffnesses
      = "set Normal stiffness = 82e9\nset Shear stiffness = 36e9\n";

  /** A set called "bed" of which the parameter file says @p text. */
  JointSetParameters read(const std::string &text)
  {
    return read_named_section<JointSetParameters>("bed", text);
  }

  void expect_refused(const std::string &text, const std::string &setting,
                      const std::string &why)
  {
    expect_section_refused("bed", setting + "' ", why,
                           [&] { read(stiffnesses + text); });
  }
} // namespace

TEST(JointParameters, Coulomb)
{
  const auto set = read(stiffnesses
                        + "set Curves = bed, head\n"
                          "set Cohesion = 0.375e6\n"
                          "set Friction angle = 45\n"
                          "set Tensile strength = 0.25e6\n"
                          "set Dilation angle = 30\n"
                          "set Critical shear displacement = 2e-3\n"
                          "set Residual cohesion = 1e3\n"
                          "set Residual friction angle = 60\n"
                          "set Residual tensile strength = 2e3\n");
  EXPECT_EQ(set.name, "bed");
  EXPECT_EQ(set.curves, (std::vector<std::string>{ "bed", "head" }));
  const auto &law = std::get<CoulombLaw>(set.law);
  EXPECT_EQ(law.normal_stiffness, 82e9);
  EXPECT_EQ(law.shear_stiffness, 36e9);
  EXPECT_EQ(law.peak.cohesion, 0.375e6);
  EXPECT_DOUBLE_EQ(law.peak.friction, 1.);
  EXPECT_EQ(law.peak.tension, 0.25e6);
  EXPECT_DOUBLE_EQ(law.dilation, 1. / std::sqrt(3.));
  EXPECT_EQ(law.critical_shear_displacement, 2e-3);
  EXPECT_EQ(law.residual.cohesion, 1e3);
  EXPECT_DOUBLE_EQ(law.residual.friction, std::sqrt(3.));
  EXPECT_EQ(law.residual.tension, 2e3);
}

TEST(JointParameters, OwnNameSameFrictionAndNoResidualByDefault)
{
  const auto set = read(stiffnesses
                        + "set Cohesion = 1e6\n"
                          "set Friction angle = 45\n"
                          "set Tensile strength = 1e5\n");
  EXPECT_EQ(set.curves, (std::vector<std::string>{ "bed" }));
  const auto &law = std::get<CoulombLaw>(set.law);
  EXPECT_EQ(law.residual.cohesion, 0.);
  EXPECT_EQ(law.residual.tension, 0.);
  EXPECT_EQ(law.residual.friction, law.peak.friction);
  EXPECT_EQ(law.dilation, 0.);
}

TEST(JointParameters, Elastic)
{
  const auto set = read(stiffnesses + "set Law = elastic\n");
  JointPoint<2> point;
  std::get<CoulombLaw>(set.law).update(point, 1., 1.);
  EXPECT_EQ(point.state, JointState::intact);
  EXPECT_EQ(point.normal_traction, 82e9);
  EXPECT_EQ(point.shear_traction, 36e9);
}

TEST(JointParameters, NoTension)
{
  const auto set  = read(stiffnesses
                         + "set Law = no tension\n"
                            "set Cohesion = 1e6\n"
                            "set Friction angle = 45\n");
  const auto &law = std::get<CoulombLaw>(set.law);
  EXPECT_EQ(law.peak.tension, 0.);
  EXPECT_EQ(law.residual.tension, 0.);
  EXPECT_EQ(law.residual.cohesion, 1e6);
  EXPECT_EQ(law.residual.friction, law.peak.friction);
  EXPECT_EQ(law_text(set.law),
            "no tension, friction angle 45 degrees, cohesion 1e+06 Pa");
}

TEST(JointParameters, RefusesWhatMakesNoSense)
{
  expect_refused("set Normal stiffness = -1\n", "Normal stiffness = -1",
                 "positive");
  expect_refused("set Shear stiffness = 0\n", "Shear stiffness = 0",
                 "positive");
  expect_refused("set Cohesion = -3\n", "Cohesion = -3", "negative");
  expect_refused("set Tensile strength = -3\n", "Tensile strength = -3",
                 "negative");
  expect_refused("set Friction angle = 90\n", "Friction angle = 90",
                 "between 0 and 89");
  expect_refused("set Friction angle = 20\nset Dilation angle = 21\n",
                 "Dilation angle = 21", "between 0 and 20");
  expect_refused("set Friction angle = 35\nset Residual friction angle = 15\n"
                 "set Dilation angle = 25\n",
                 "Dilation angle = 25", "between 0 and 15");
  expect_refused("set Residual friction angle = some\n",
                 "Residual friction angle = some", "1 numbers");
  expect_refused("set Residual friction angle = -4\n",
                 "Residual friction angle = -4", "between 0 and 'Friction");
  expect_refused("set Friction angle = 40\n"
                 "set Residual friction angle = 55\n",
                 "Residual friction angle = 55", "'Friction angle', or");
  expect_refused("set Residual cohesion = 1\n", "Residual cohesion = 1",
                 "must not exceed 'Cohesion'");
  expect_refused("set Residual tensile strength = 1\n",
                 "Residual tensile strength = 1",
                 "must not exceed 'Tensile strength'");
  expect_refused("set Law = no tension\nset Tensile strength = 5\n",
                 "Tensile strength = 5", "Coulomb");
  expect_refused("set Law = no tension\nset Residual cohesion = 1\n",
                 "Residual cohesion = 1", "no effect with 'Law = no tension'");
}
