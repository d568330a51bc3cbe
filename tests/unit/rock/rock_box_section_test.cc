// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/rock/rock_box.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  /** Reads a box with one joint set, and entries of the two sections. */
  RockBoxParameters read_box(const std::string &box, const std::string &set)
  {
    dealii::ParameterHandler prm;
    prm.enter_subsection("Rock box");
    RockBoxParameters::declare(prm);
    prm.leave_subsection();
    prm.enter_subsection("Rock joint sets");
    prm.declare_entry("Names", "", dealii::Patterns::Anything(), "");
    prm.enter_subsection("bedding");
    SpaceJointSet::declare(prm);
    prm.leave_subsection();
    prm.leave_subsection();
    prm.parse_input_from_string(
        "subsection Rock box\nset Highest corner = 4, 3, 2\n"
        "set Element size = 1\n"
        + box
        + "\nend\nsubsection Rock joint sets\nset Names = bedding\n"
          "subsection bedding\nset Spacing = 1\n"
        + set + "\nend\nend\n");
    return RockBoxParameters::read(ParameterSection(prm, "box.prm"));
  }

  void expect_refusal(const std::string &box, const std::string &set,
                      const std::vector<std::string> &words)
  {
    try
    {
      read_box(box, set);
      ADD_FAILURE() << "accepted: " << box << set;
    }
    catch (const InputError &error)
    {
      for (const std::string &word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
            << error.what();
    }
  }
} // namespace

TEST(RockBoxSection, ReadsASet)
{
  const RockBoxParameters rock
      = read_box("", "set Dip = 40\nset Dip direction = 130\n"
                     "set Persistence = 0.5\nset Origin = 1, 2, 3");
  ASSERT_EQ(rock.sets.size(), 1u);
  EXPECT_EQ(rock.sets[0].dip, 40.);
  EXPECT_EQ(rock.sets[0].dip_direction, 130.);
  EXPECT_EQ(rock.sets[0].persistence, 0.5);
  EXPECT_EQ(rock.sets[0].origin, dealii::Point<3>(1, 2, 3));
  // A plane that dips to the east has a normal that leans there.
  EXPECT_NEAR(plane_normal(30, 90)[0], 0.5, 1e-15);
  EXPECT_NEAR(plane_normal(30, 0)[1], 0.5, 1e-15);
}

TEST(RockBoxSection, RefusesWhatIsNoJointSet)
{
  expect_refusal("", "set Dip = 91", { "box.prm", "bedding", "Dip", "91" });
  expect_refusal("", "set Dip direction = -1", { "Dip direction", "-1" });
  expect_refusal("", "set Spacing = 0", { "bedding", "Spacing", "0" });
  expect_refusal("", "set Spacing = -2", { "Spacing", "-2" });
  expect_refusal("", "set Spacing = Fisher 2, 1", { "Spacing", "Fisher" });
  expect_refusal("", "set Persistence = 1.5", { "Persistence", "1.5" });
  expect_refusal("", "set Fisher concentration = -1",
                 { "Fisher concentration", "-1" });
}

TEST(RockBoxSection, RefusesWhatIsNoBox)
{
  expect_refusal("set Highest corner = 4, -3, 2", "",
                 { "box.prm", "Rock box", "Highest corner" });
  expect_refusal("set Sides = a, b", "", { "Sides", "six" });
  expect_refusal("set Sides = bedding, b, c, d, e, f", "",
                 { "Names", "bedding" });
  expect_refusal("set Element size = 0", "", { "Element size" });
}
