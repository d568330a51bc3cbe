// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/rock/rock_parameters.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  RockParameters read(const std::string &text)
  {
    dealii::ParameterHandler prm;
    for (const std::string section : { "Rock regions", "Rock joints" })
    {
      prm.enter_subsection(section);
      prm.declare_entry("Names", "", dealii::Patterns::Anything(), "");
      prm.leave_subsection();
    }
    prm.enter_subsection("Rock");
    RockParameters::declare(prm);
    prm.leave_subsection();
    prm.enter_subsection("Rock joints");
    prm.enter_subsection("bedding");
    RockJoints::declare(prm);
    prm.leave_subsection();
    prm.leave_subsection();
    prm.parse_input_from_string(text);
    return RockParameters::read(ParameterSection(prm, "slope.prm"));
  }

  std::string rock(const std::string &outline, const std::string &sides)
  {
    return "subsection Rock\nset Element size = 1\nset Outline = " + outline
           + "\nset Sides = " + sides + "\nend\n";
  }
} // namespace

TEST(RockSection, SidesOfAClockwiseOutlineAreTurnedWithIt)
{
  const auto names = [](const RockParameters &read)
  {
    std::vector<std::string> result; // in the order base, right, ...
    for (std::size_t i = 0; i < read.outline.size(); ++i)
      for (std::size_t j = 0; j < read.outline.size(); ++j)
        if (read.outline[j]
            == std::vector<dealii::Point<2>>{ { 0, 0 }, { 9, 0 }, { 5, 7 } }[i])
          result.push_back(read.sides[j]);
    return result;
  };
  const std::vector<std::string> expected = { "base", "right", "left" };
  EXPECT_EQ(names(read(rock("0, 0; 9, 0; 5, 7", "base, right, left"))),
            expected);
  EXPECT_EQ(names(read(rock("0, 0; 5, 7; 9, 0", "left, right, base"))),
            expected);
}

TEST(RockSection, ZeroIsNoGapHoweverItIsWritten)
{
  for (const std::string gap : { "0", "0.0", "0e0", "2" })
  {
    const RockParameters parameters
        = read(rock("0, 0; 9, 0; 5, 7", "")
               + "subsection Rock joints\nset Names = bedding\n"
                 "subsection bedding\nset Spacing = 1\n"
                 "set Trace length = 3\nset Gap = "
               + gap + "\nend\nend\n");
    EXPECT_EQ(parameters.joints.at(0).gap.mean, gap == "2" ? 2. : 0.) << gap;
  }
}
