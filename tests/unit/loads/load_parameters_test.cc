// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"

#include <quoin/loads/load_parameters.h>

using namespace quoin;

namespace
{
  /** A load called "push" of which the parameter file says @p text. */
  LoadParameters read(const std::string &text)
  {
    return read_named_section<LoadParameters>("push", text);
  }

  void expect_refused(const std::string &text, const std::string &setting,
                      const std::string &why)
  {
    expect_section_refused("push", setting + "' ", why, [&] { read(text); });
  }

  double value(const LoadParameters &load, const unsigned int component)
  {
    return load.components[component].value({ 2., 3. });
  }
} // namespace

TEST(LoadParameters, TruncatedBoundaries)
{
  auto load = read("set Type = viscous boundary\n"
                   "set Boundary = left\n"
                   "set Far field material = bedrock\n"
                   "set Incident shear velocity = 0.1*t\n");
  EXPECT_EQ(load.type, LoadType::viscous_boundary);
  EXPECT_EQ(load.far_material, "bedrock");
  EXPECT_DOUBLE_EQ(value(load, 1), 0.2);

  load = read("set Type = free-field boundary\n"
              "set Boundary = left\nset Base = below\n");
  EXPECT_EQ(load.type, LoadType::free_field);
  EXPECT_EQ(load.base, "below");
  expect_refused("set Type = free-field boundary\nset Boundary = left\n",
                 "Base = ", "must name the load");
  expect_refused("set Type = free-field boundary\nset Base = below\n",
                 "Boundary = ", "physical curve");
}

TEST(LoadParameters, PrescribedMotion)
{
  auto load = read("set Type = prescribed motion\n"
                   "set Boundary = left, right\n"
                   "set Horizontal = 0.1*t\n");
  EXPECT_EQ(load.name, "push");
  EXPECT_EQ(load.type, LoadType::prescribed_motion);
  EXPECT_EQ(load.boundaries, (std::vector<std::string>{ "left", "right" }));
  EXPECT_EQ(load.components[0].quantity, LoadQuantity::velocity);
  EXPECT_DOUBLE_EQ(value(load, 0), 0.2);
  EXPECT_EQ(load.components[1].quantity, LoadQuantity::free);

  load = read("set Type = prescribed motion\nset Boundary = left\n"
              "set Quantity = displacement\nset Vertical = T\n"
              "set Horizontal = velocity 4\n");
  EXPECT_EQ(load.components[1].quantity, LoadQuantity::displacement);
  EXPECT_EQ(value(load, 1), 3.);
  EXPECT_EQ(load.components[0].quantity, LoadQuantity::velocity);
  EXPECT_EQ(value(load, 0), 4.);
}

TEST(LoadParameters, TractionAndGravity)
{
  auto load = read("set Type = traction\nset Boundary = top\n"
                   "set Vertical = -1e6\n");
  EXPECT_EQ(load.components[1].quantity, LoadQuantity::force);
  EXPECT_EQ(value(load, 1), -1e6);
  EXPECT_EQ(value(load, 0), 0.);

  load = read("set Type = gravity\nset Vertical = -9.81\n");
  EXPECT_EQ(load.type, LoadType::gravity);
  EXPECT_EQ(value(load, 1), -9.81);
}

TEST(LoadParameters, Platen)
{
  auto load = read("set Type = platen\nset Group = beam\n"
                   "set Horizontal = force -29.7e3\n"
                   "set Vertical = displacement 1e-3*t\n"
                   "set Rotation = velocity 5\n");
  EXPECT_EQ(load.groups, (std::vector<std::string>{ "beam" }));
  EXPECT_EQ(load.components[0].quantity, LoadQuantity::force);
  EXPECT_EQ(value(load, 0), -29.7e3);
  EXPECT_EQ(load.components[1].quantity, LoadQuantity::displacement);
  EXPECT_EQ(value(load, 1), 2e-3);
  EXPECT_EQ(load.components[2].quantity, LoadQuantity::velocity);
  EXPECT_EQ(value(load, 2), 5.);

  load = read("set Type = platen\nset Boundary = top\n"
              "set Rotation = moment 7\n");
  EXPECT_EQ(load.components[2].quantity, LoadQuantity::force);
  EXPECT_EQ(load.components[0].quantity, LoadQuantity::free);
}

TEST(LoadParameters, ViscousBoundary)
{
  const auto load = read("set Type = viscous boundary\nset Boundary = base\n"
                         "set Incident shear velocity = 0.5*t\n");
  EXPECT_EQ(value(load, 0), 0.);
  EXPECT_EQ(value(load, 1), 1.);
}

TEST(LoadParameters, InitialStress)
{
  const auto load = read("set Type = initial stress\nset Groups = rock\n"
                         "set Stress = -1e6, -2e6, 3e5\n"
                         "set Stress gradient = 1, 2, 3\n");
  EXPECT_EQ(load.groups, (std::vector<std::string>{ "rock" }));
  EXPECT_EQ(load.stress, (std::array<double, 3>{ { -1e6, -2e6, 3e5 } }));
  EXPECT_EQ(load.stress_gradient, (std::array<double, 3>{ { 1., 2., 3. } }));
}

TEST(LoadParameters, TablesLieNextToTheParameterFile)
{
  expect_refused("set Type = traction\nset Boundary = top\n"
                 "set Vertical = table t.csv\n",
                 "Vertical = table t.csv", "'./t.csv' cannot be read");
}

TEST(LoadParameters, RefusesWhatMakesNoSense)
{
  expect_refused("set Type = traction\nset Vertical = 1\n",
                 "Boundary = ", "must name a physical curve");
  expect_refused("set Type = viscous boundary\n",
                 "Boundary = ", "must name a physical curve");
  expect_refused("set Type = prescribed motion\nset Horizontal = 0\n",
                 "Boundary = ", "must name a physical curve");
  expect_refused("set Type = traction\nset Boundary = top\n"
                 "set Horizontal = 2*q\n",
                 "Horizontal = 2*q", "is no expression of t and T");
  expect_refused("set Type = prescribed motion\nset Boundary = top\n"
                 "set Vertical = force 5\n",
                 "Vertical = force 5", "traction");
  expect_refused("set Type = platen\nset Boundary = top\n"
                 "set Vertical = 5\n",
                 "Vertical = 5", "must be 'free' or begin with");
  expect_refused("set Type = platen\n", "Group = ", "one of the two");
  expect_refused("set Type = platen\nset Group = a\nset Boundary = b\n",
                 "Group = a", "one of the two");
  expect_refused("set Type = initial stress\nset Stress = 1, 2\n",
                 "Stress = 1, 2", "must be three numbers");
}

TEST(LoadParameters, RefusesMotionWhereAForceIsMeant)
{
  expect_refused("set Type = traction\nset Boundary = top\n"
                 "set Horizontal = velocity 5\n",
                 "Horizontal = velocity 5", "traction");
  expect_refused("set Type = gravity\nset Vertical = displacement 5\n",
                 "Vertical = displacement 5", "gravity");
  expect_refused("set Type = viscous boundary\nset Boundary = base\n"
                 "set Incident normal velocity = force 5\n",
                 "Incident normal velocity = force 5", "viscous boundary");
}

TEST(LoadParameters, ComponentsAlongTheAxes)
{
  const auto force = [](const std::string &value) {
    return LoadComponent{ LoadQuantity::force, TimeFunction(value, "") };
  };
  LoadParameters load;
  load.name       = "push";
  load.type       = LoadType::traction;
  load.components = { force("1"), force("2"), {} };
  EXPECT_EQ(component_values(load.along_axes<2>().components, {}),
            (std::array<double, 3>{ { 1., 2., 0. } }));
  load.lateral = force("3");
  EXPECT_EQ(component_values(load.along_axes<3>().components, {}),
            (std::array<double, 3>{ { 1., 3., 2. } }));
  EXPECT_EQ(load.given_components().size(), 3U);
  const std::string refusal
      = message_of<InputError>([&]() { load.along_axes<2>(); });
  EXPECT_NE(refusal.find("'Lateral'"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("Loads/push"), std::string::npos) << refusal;
}

TEST(LoadParameters, HeightsInThePlaneAreNoZ)
{
  const std::string type = "set Type = traction\nset Boundary = top\n";
  const auto says        = [&](const std::string &text)
  {
    const LoadParameters load = read(type + text + "\n");
    load.along_axes<3>();
    return message_of<InputError>([&]() { load.along_axes<2>(); });
  };
  for (const auto &[entry, text] :
       { std::make_pair("'Pressure'", "set Pressure = 9810*max(0, 12 - z)"),
         std::make_pair("'Horizontal'", "set Horizontal = z*t"),
         std::make_pair("'Vertical'",
                        "set Vertical = pulse half-sine 1 times z"),
         std::make_pair("'Distribution'",
                        "set Vertical = 1\nset Distribution = 1 - z/4") })
  {
    const std::string refusal = says(text);
    EXPECT_NE(refusal.find(entry), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("Loads/push"), std::string::npos) << refusal;
  }
  const std::string none = "nothing was thrown";
  EXPECT_EQ(says("set Pressure = 9810*max(0, 12 - y)"), none);
  EXPECT_EQ(says("set Pressure = water 12"), none);
}
