// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "section_text.h"

#include <quoin/base/constants.h>
#include <quoin/base/parameter_entries.h>

#include <limits>

using namespace quoin;

namespace
{
  enum class Bond
  {
    stack,
    running
  };

  struct Wall
  {
    double height                = 2.5;
    double ratio                 = 1e-7;
    double angle                 = 30. * constants::degree;
    double end                   = std::numeric_limits<double>::infinity();
    double offset                = 0.0005;
    std::uint64_t courses        = 10000000;
    bool is_dry                  = false;
    Bond bond                    = Bond::running;
    std::array<double, 2> joints = { { 0., 0.01 } };
    std::string name             = "wall";
    std::vector<std::string> parts;
    std::vector<std::pair<std::string, std::string>> links;
    bool links_all = false;

    static void enter(ParameterEntries &entries, Wall &wall)
    {
      entries.choice("Bond", wall.bond,
                     { { "stack", Bond::stack },
                       { "running", Bond::running },
                       { "half", Bond::running } },
                     "Bond.");
      if (entries.reads_if(wall.bond == Bond::running))
        entries.within("Offset", wall.offset, 0., 1., "Offset [-]");
      entries.positive("Height", wall.height, "Height [m]");
      entries.nonnegative("Ratio", wall.ratio, "Ratio [-]");
      entries.within("Angle", wall.angle, 0., 90., "Angle [deg]",
                     constants::degree);
      entries.number_or("never", std::numeric_limits<double>::infinity(), "End",
                        wall.end, "End [s]");
      entries.integer("Courses", wall.courses, 1, "Number of courses [-]");
      entries.flag("Dry", wall.is_dry, "Whether it is dry.");
      entries.numbers("Joints", wall.joints, "Joints [m]");
      entries.text("Name", wall.name, "Name.");
      entries.list("Parts", wall.parts, "Parts.");
      entries.pairs("Links", wall.links, "must be pairs.", "Links.",
                    &wall.links_all);
    }
  };

  Wall read(const std::string &text)
  {
    return read_section(
        "Wall", text,
        [](dealii::ParameterHandler &prm)
        { declare_entries(prm, Wall::enter); },
        [](const ParameterSection &section)
        { return read_entries(section, Wall::enter); });
  }
} // namespace

TEST(ParameterEntries, DeclareTheValuesOfANewObjectAsDefaults)
{
  dealii::ParameterHandler prm;
  declare_entries(prm, Wall::enter);
  const std::vector<std::array<const char *, 2>> expected
      = { { { "Bond", "running" } },     { { "Offset", "0.0005" } },
          { { "Height", "2.5" } },       { { "Ratio", "1e-7" } },
          { { "Angle", "30" } },         { { "End", "never" } },
          { { "Courses", "10000000" } }, { { "Dry", "no" } },
          { { "Joints", "0, 0.01" } },   { { "Name", "wall" } },
          { { "Parts", "" } },           { { "Links", "" } } };
  for (const auto &[name, preset] : expected)
    EXPECT_EQ(prm.get(name), preset) << name;
}

TEST(ParameterEntries, ReadWhatIsGivenAndElseTheDefaults)
{
  const Wall wall = read("set Bond = half\nset Angle = 45\nset End = 3\n"
                         "set Joints = 1, 2\nset Parts = a, b\nset Dry = true\n"
                         "set Courses = 7\nset Links = a:b, all, c : d\n");
  EXPECT_EQ(wall.bond, Bond::running);
  EXPECT_EQ(wall.angle, 45. * constants::degree);
  EXPECT_EQ(wall.end, 3.);
  EXPECT_EQ(wall.joints, (std::array<double, 2>{ { 1., 2. } }));
  EXPECT_EQ(wall.parts, (std::vector<std::string>{ "a", "b" }));
  EXPECT_TRUE(wall.is_dry);
  EXPECT_EQ(wall.courses, 7U);
  EXPECT_EQ(wall.links, (std::vector<std::pair<std::string, std::string>>{
                            { "a", "b" }, { "c", "d" } }));
  EXPECT_TRUE(wall.links_all);
  const Wall preset;
  EXPECT_EQ(wall.height, preset.height);
  EXPECT_EQ(wall.ratio, preset.ratio);
  EXPECT_EQ(wall.name, preset.name);
  EXPECT_EQ(read("").end, preset.end);
}

TEST(ParameterEntries, RefuseWrongValuesWithSectionAndValue)
{
  const auto refused = [](const std::string &setting, const std::string &why)
  {
    expect_section_refused("Wall", setting, why,
                           [&]() { read("set " + setting + "\n"); });
  };
  refused("Height = 0", "must be positive");
  refused("Ratio = -1", "must not be negative");
  // The range is that of the file, not of the program's unit.
  refused("Angle = 91", "must lie between 0 and 90");
  refused("Joints = 1", "must be 2 numbers");
  refused("End = soon", "must be 1 numbers");
}

TEST(ParameterEntries, DoNotReadWhatItsConditionLeavesOut)
{
  EXPECT_EQ(read("set Bond = stack\nset Offset = 7\n").offset, Wall().offset);
  expect_section_refused("Wall", "Offset = 7", "must lie between 0 and 1",
                         []() { read("set Offset = 7\n"); });
}
