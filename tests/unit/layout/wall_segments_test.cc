// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/layout/wall_parameters.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  void declare_named(dealii::ParameterHandler &prm, const std::string &section,
                     const std::vector<std::string> &names,
                     void (*declare)(dealii::ParameterHandler &))
  {
    prm.enter_subsection(section);
    prm.declare_entry("Names", "", dealii::Patterns::Anything(), "");
    for (const std::string &name : names)
    {
      prm.enter_subsection(name);
      declare(prm);
      prm.leave_subsection();
    }
    prm.leave_subsection();
  }

  /** Reads @p text, of a wall of storeys low and high and segments south and
      west. */
  WallParameters read_wall(const std::string &text)
  {
    dealii::ParameterHandler prm;
    prm.enter_subsection("Mesh");
    prm.declare_entry("Dimension", "3", dealii::Patterns::Anything(), "");
    prm.leave_subsection();
    prm.enter_subsection("Wall");
    WallParameters::declare(prm);
    prm.leave_subsection();
    declare_named(prm, "Wall storeys", { "low", "high" }, WallStorey::declare);
    declare_named(prm, "Wall segments", { "south", "west" },
                  WallSegment::declare);
    prm.parse_input_from_string(
        "subsection Wall\nset Bond = running\nset Unit length = 0.23\n"
        "set Unit height = 0.07\nset Joint thickness = 0.01, 0.01\n"
        "set Thickness = 0.12\nend\n"
        + text);
    return WallParameters::read(ParameterSection(prm, "wall.prm"));
  }
} // namespace

TEST(WallSegments, HaveOpeningsInCoursesOfAllStoreys)
{
  const WallParameters wall = read_wall(
      "subsection Wall storeys\nset Names = low, high\n"
      "subsection low\nset Courses = 6\nset Slab thickness = 0.2\nend\n"
      "subsection high\nset Courses = 5\nset Header courses =\nend\nend\n"
      "subsection Wall segments\nset Names = south, west\n"
      "subsection south\nset Start = 1, 2\nset Length = 2.4\n"
      "set Openings = 0.6, 1.2, 2, 6; 0.6, 0.96, 8, 10\nend\n"
      "subsection west\nset Start = 1, 1.5\nset Direction = y\n"
      "set Length = 1.2\nend\nend\n");
  ASSERT_EQ(wall.segments.size(), 2u);
  EXPECT_NEAR(wall.length, 3.6, 1e-12);
  const WallSegment &south = wall.segments[0];
  ASSERT_EQ(south.openings.size(), 2u);
  ASSERT_EQ(south.openings[0].size(), 1u);
  EXPECT_EQ(south.openings[0][0].last_course, 6u);
  ASSERT_EQ(south.openings[1].size(), 1u);
  EXPECT_EQ(south.openings[1][0].first_course, 2u);
  EXPECT_EQ(south.openings[1][0].last_course, 4u);
  const auto [low, high] = wall.segments[1].corners(wall.thickness);
  EXPECT_NEAR(low.distance(dealii::Point<2>(1., 1.5)), 0., 1e-12);
  EXPECT_NEAR(high.distance(dealii::Point<2>(1.12, 2.7)), 0., 1e-12);
}

TEST(WallSegments, AreOneWithoutNames)
{
  const WallParameters wall
      = read_wall("subsection Wall\nset Length = 2.4\nset Courses = 9\n"
                  "set Wythes = 2\nset Header courses = 3, 6-7\n"
                  "set Openings = 0.6, 1.2, 2, 6\nend\n");
  ASSERT_EQ(wall.segments.size(), 1u);
  EXPECT_EQ(wall.segments[0].name, "");
  EXPECT_EQ(wall.segments[0].openings[0].size(), 1u);
  EXPECT_EQ(wall.storeys[0].header_courses,
            (std::set<unsigned int>{ 3, 6, 7 }));
}
