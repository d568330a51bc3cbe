// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"

#include <quoin/joint_laws/joint_parameters.h>

using namespace quoin;

namespace
{
  const std::string wall = "set Normal stiffness = 82e9\n"
                           "set Shear stiffness = 36e9\n"
                           "set Tensile strength = 0.25e6\n"
                           "set Tensile fracture energy = 18\n"
                           "set Cohesion = 0.35e6\n"
                           "set Shear fracture energy = 125\n"
                           "set Friction angle = 36.87\n"
                           "set Compressive strength = 10.5e6\n"
                           "set Compressive fracture energy = 5000\n"
                           "set Peak crushing = 0.09e-3\n";

  CompositeLaw read(const std::string &text)
  {
    return std::get<CompositeLaw>(read_named_section<JointSetParameters>(
                                      "bed", "set Law = composite\n" + text)
                                      .law);
  }

  void expect_refused(const std::string &text, const std::string &setting,
                      const std::string &why)
  {
    expect_section_refused("bed", setting + " = ", why,
                           [&] { read(wall + text); });
  }
} // namespace

TEST(CompositeParameters, ReadsAll)
{
  const CompositeLaw law = read(wall
                                + "set Residual friction angle = 30\n"
                                  "set Dilation angle = 20\n"
                                  "set Dilation pressure = 1.3e6\n"
                                  "set Dilation decay = 1500\n"
                                  "set Cap shear = 4\n"
                                  "set Cap normal = 2\n"
                                  "set Cap offset = 1e5\n");
  EXPECT_EQ(law.normal_stiffness, 82e9);
  EXPECT_EQ(law.shear_stiffness, 36e9);
  EXPECT_EQ(law.tension, 0.25e6);
  EXPECT_EQ(law.tension_energy, 18.);
  EXPECT_EQ(law.cohesion, 0.35e6);
  EXPECT_EQ(law.shear_energy, 125.);
  EXPECT_NEAR(law.friction, 0.75, 1e-5);
  EXPECT_DOUBLE_EQ(law.residual_friction, 1. / std::sqrt(3.));
  EXPECT_NEAR(law.dilation, 0.36397, 1e-5);
  EXPECT_EQ(law.dilation_pressure, 1.3e6);
  EXPECT_EQ(law.dilation_decay, 1500.);
  EXPECT_EQ(law.cap.compression, 10.5e6);
  EXPECT_EQ(law.cap.compression_energy, 5000.);
  EXPECT_EQ(law.cap.peak_crushing, 0.09e-3);
  EXPECT_EQ(law.cap.shear, 4.);
  EXPECT_EQ(law.cap.normal, 2.);
  EXPECT_EQ(law.cap.offset, 1e5);
}

TEST(CompositeParameters, NoneIsInfinite)
{
  const CompositeLaw law = read("set Normal stiffness = 82e9\n"
                                "set Shear stiffness = 36e9\n"
                                "set Friction angle = 30\n");
  EXPECT_EQ(law.tension, 0.);
  EXPECT_EQ(law.tension_energy, CompositeLaw::infinity);
  EXPECT_EQ(law.shear_energy, CompositeLaw::infinity);
  EXPECT_EQ(law.dilation_pressure, CompositeLaw::infinity);
  EXPECT_EQ(law.cap.compression, CompositeLaw::infinity);
  EXPECT_EQ(law.residual_friction, law.friction);
}

TEST(CompositeParameters, WarnsOfALawThatSnapsBack)
{
  EXPECT_EQ(read(wall).warning(), "");
  const std::string warning
      = read(wall + "set Tensile fracture energy = 0.5\n").warning();
  EXPECT_NE(warning.find("ft^2 / GfI = 1.25e+11 Pa/m"), std::string::npos)
      << warning;
}

TEST(CompositeParameters, Refuses)
{
  expect_refused("set Tensile fracture energy = 0\n", "Tensile fracture energy",
                 "or 'none'");
  expect_refused("set Shear fracture energy = -1\n", "Shear fracture energy",
                 "or 'none'");
  expect_refused("set Tensile strength = 0.5e6\n", "Tensile strength",
                 "must not exceed 'Cohesion' over");
  expect_refused("set Residual friction angle = 60\n", "Tensile strength",
                 "must not exceed 'Cohesion' over");
  expect_refused("set Residual friction angle = 95\n",
                 "Residual friction angle", "or be 'same'");
  expect_refused("set Residual friction angle = 20\nset Dilation angle = 25\n",
                 "Dilation angle", "20");
  expect_refused("set Dilation pressure = 0\n", "Dilation pressure",
                 "or 'none'");
  expect_refused("set Peak crushing = 0\n", "Peak crushing", "positive");
  expect_refused("set Compressive fracture energy = 0\n",
                 "Compressive fracture energy", "positive");
  expect_refused("set Cap shear = 0\n", "Cap shear", "positive");
}
