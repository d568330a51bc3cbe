// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "message_of.h"

#include <quoin/base/exceptions.h>
#include <quoin/base/parameter_section.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  void declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    prm.declare_entry("Title", "wall", Anything());
    prm.enter_subsection("Outer");
    prm.enter_subsection("Inner");
    prm.declare_entry("Number", "-2.5", Double());
    prm.declare_entry("Zero", "0", Double());
    prm.declare_entry("Words", "a, b c ,d", Anything());
    prm.declare_entry("Nothing", "", Anything());
    prm.declare_entry("Gap", "a,,b", Anything());
    prm.declare_entry("Three", "1, -2e3, 0.5", Anything());
    prm.declare_entry("Points", "0, 1; 2, -3e0", Anything());
    prm.declare_entry("Flag", "yes", Anything());
    prm.leave_subsection();
    prm.leave_subsection();
  }

  std::string folder_of(const std::string &file)
  {
    dealii::ParameterHandler prm;
    return ParameterSection(prm, file).folder();
  }
} // namespace

TEST(ParameterSection, FolderOfTheFile)
{
  EXPECT_EQ(folder_of("case.prm"), "./");
  EXPECT_EQ(folder_of("a/b/case.prm"), "a/b/");
  EXPECT_EQ(folder_of("/data/case.prm"), "/data/");
}

TEST(ParameterSection, ReadsValues)
{
  dealii::ParameterHandler prm;
  declare(prm);
  const ParameterSection top(prm, "dir/case.prm");
  EXPECT_EQ(top.text("Title"), "wall");
  {
    const ParameterSection outer(top, "Outer");
    const ParameterSection inner(outer, "Inner");
    EXPECT_EQ(inner.number("Number"), -2.5);
    EXPECT_EQ(inner.nonnegative("Zero"), 0.);
    EXPECT_EQ(inner.within("Number", -2.5, 1.), -2.5);
    EXPECT_EQ(inner.list("Words"),
              (std::vector<std::string>{ "a", "b c", "d" }));
    EXPECT_TRUE(inner.list("Nothing").empty());
    EXPECT_THROW(inner.list("Gap"), InputError);
    EXPECT_EQ(inner.numbers<3>("Three"),
              (std::array<double, 3>{ { 1., -2000., 0.5 } }));
    EXPECT_EQ(number_rows(inner, "Points", 2, ""),
              (std::vector<std::vector<double>>{ { 0., 1. }, { 2., -3. } }));
    EXPECT_TRUE(number_rows(inner, "Nothing", 2, "").empty());
    EXPECT_EQ(inner.folder(), "dir/");
  }
  // Both subsections have been left.
  EXPECT_EQ(top.text("Title"), "wall");
}

TEST(ParameterSection, ErrorsNameFileSectionParameterAndValue)
{
  dealii::ParameterHandler prm;
  declare(prm);
  const ParameterSection top(prm, "dir/case.prm");
  const ParameterSection outer(top, "Outer");
  const ParameterSection inner(outer, "Inner");
  const std::string where = "dir/case.prm, section 'Outer/Inner': ";
  const auto error
      = [](const auto &task) { return message_of<InputError>(task); };

  EXPECT_EQ(error([&] { inner.positive("Zero"); })
                .find(where + "'Zero = 0' must be positive"),
            0U);
  EXPECT_EQ(error([&] { inner.nonnegative("Number"); })
                .find(where + "'Number = -2.5' must not be negative"),
            0U);
  EXPECT_EQ(error([&] { inner.within("Number", 0., 1.); })
                .find(where + "'Number = -2.5' must lie between 0 and 1"),
            0U);
  EXPECT_EQ(error([&] { inner.within("Number", -5., -3.); })
                .find(where + "'Number = -2.5' must lie between -5 and -3"),
            0U);
  EXPECT_EQ(error([&] { inner.numbers<2>("Three"); })
                .find(where + "'Three = 1, -2e3, 0.5' must be 2 numbers"),
            0U);
  EXPECT_EQ(error([&] { inner.numbers<3>("Words"); })
                .find(where + "'Words = a, b c ,d' must be 3 numbers"),
            0U);
  EXPECT_EQ(error([&] { number_rows(inner, "Points", 3, "must be rows."); })
                .find(where + "'Points = 0, 1; 2, -3e0' must be rows."),
            0U);
  EXPECT_EQ(error(
                [&] {
                  inner.choice<int>("Flag", { { "on", 1 }, { "off", 0 } });
                })
                .find(where + "'Flag = yes' must be one of: on, off."),
            0U);
  EXPECT_EQ(inner.choice<int>("Flag", { { "no", 1 }, { "yes", 7 } }), 7);
}
