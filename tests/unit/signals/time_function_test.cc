// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "../output/temporary_directory.h"

#include <quoin/base/exceptions.h>
#include <quoin/signals/time_function.h>

#include <cmath>

using namespace quoin;

namespace
{
  double at(const std::string &text, const double stage,
            const double total = 0., const std::string &folder = "./")
  {
    return TimeFunction(text, folder)({ stage, total });
  }

  void write(const std::string &path, const std::string &text)
  {
    std::ofstream(path) << text;
  }

  /** What is wrong with the table @p text. */
  std::string complaint(const std::string &text)
  {
    const TemporaryDirectory directory;
    write(directory / "t.csv", text);
    return message_of<InputError>(
        [&] { TimeFunction("table t.csv", directory.path() + "/"); });
  }
} // namespace

TEST(TimeFunction, ZeroUnlessGiven)
{
  EXPECT_EQ(TimeFunction()({ 3., 4. }), 0.);
}

TEST(TimeFunction, ExpressionsOfBothTimes)
{
  EXPECT_EQ(at("-9.81", 2.), -9.81);
  EXPECT_EQ(at("2*t", 1.5, 100.), 3.);
  EXPECT_EQ(at("T - t", 1.5, 100.), 98.5);
  EXPECT_EQ(at("pi", 0.), 3.14159265358979323846);
  EXPECT_DOUBLE_EQ(at("1e6*sin(2*pi*t) + exp(-T)", 0.2, 0.7),
                   1e6 * std::sin(0.4 * std::acos(-1.)) + std::exp(-0.7));
}

TEST(TimeFunction, NamesTheTotalTimeOrNot)
{
  for (const std::string text : { "T", " 2*T + t", "table T.csv times 3*T",
                                  "pulse half-sine 1 times T" })
    EXPECT_TRUE(TimeFunction::names_total(text)) << text;
  for (const std::string text : { "", "t", "table T.csv", "table T.csv times t",
                                  "record T.at2 delay 1", "wavelet Ricker 2" })
    EXPECT_FALSE(TimeFunction::names_total(text)) << text;
}

TEST(TimeFunction, ConditionalExpression)
{
  EXPECT_EQ(at("if(t < 1, 0, 1)", 0.9), 0.);
  EXPECT_EQ(at("if(t < 1, 0, 1)", 1.1), 1.);
}

TEST(TimeFunction, CopiesAreIndependentOfTheOriginal)
{
  TimeFunction copy;
  {
    const TimeFunction original("3*t", "./");
    copy = original;
  }
  EXPECT_EQ(copy({ 2., 0. }), 6.);
}

TEST(TimeFunction, BadExpressions)
{
  for (const std::string text : { "2*x", "sin(", "1 +", "" })
  {
    const std::string message
        = message_of<InputError>([&] { TimeFunction(text, "./"); });
    EXPECT_NE(message.find("is no expression of t and T"), std::string::npos)
        << "'" << text << "': " << message;
  }
}

TEST(TimeFunction, TablesAreLinearAndConstantBeyondTheirEnds)
{
  const TemporaryDirectory directory;
  write(directory / "t.csv", "# measured\ntime [s],value [m]\n"
                             "1, 10\n"
                             "2, 20  # a remark\n"
                             "\n"
                             "4,-20\r\n");
  const std::string folder = directory.path() + "/";
  const auto value
      = [&](const double t) { return at("table t.csv", t, 1000., folder); };
  EXPECT_EQ(value(-5.), 10.);
  EXPECT_EQ(value(1.), 10.);
  EXPECT_DOUBLE_EQ(value(1.25), 12.5);
  EXPECT_EQ(value(2.), 20.);
  EXPECT_DOUBLE_EQ(value(3.5), -10.);
  EXPECT_EQ(value(4.), -20.);
  EXPECT_EQ(value(1e9), -20.);

  // An absolute path does not depend on the folder.
  EXPECT_EQ(at("table " + folder + "t.csv", 4.), -20.);
}

TEST(TimeFunction, CommentsBetweenTheRowsOfATable)
{
  const TemporaryDirectory directory;
  write(directory / "t.csv", "0, 0\n# plateau\n1, 5\n2, 5\n");
  EXPECT_DOUBLE_EQ(at("table t.csv", 0.5, 0., directory.path() + "/"), 2.5);
}

TEST(TimeFunction, BadTables)
{
  const auto expect = [](const std::string &message, const std::string &part)
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("t.csv"), std::string::npos) << message;
  };
  expect(complaint("time,v\n0,1\n2,1\n1,3\n"), "goes back in time in line 4");
  expect(complaint("0,1\n0,2\n"), "has the time 0 of line 2 twice");
  expect(complaint("0,0\n0.02,0\n0.02,1\n"),
         "has the time 0.02 of line 3 twice");
  expect(complaint("0,1\n1,2\n2;3\n"), "line 3");
  expect(complaint("0,1\n1\n"), "is not a time and a value");
  expect(complaint("0;0\n1,1\n2,2\n"), "line 1");
  expect(complaint("time,value\n"), "has no rows");

  for (const std::string text : { "table times sin(t)", "table  times 2" })
  {
    const std::string message
        = message_of<InputError>([&] { TimeFunction(text, "./"); });
    EXPECT_NE(message.find("names no file"), std::string::npos) << message;
  }
  const std::string message = message_of<InputError>(
      [] { TimeFunction("table not_there.csv", "some/folder/"); });
  expect("t.csv: " + message, "some/folder/not_there.csv' cannot be read");
}

TEST(TimeFunction, Signals)
{
  EXPECT_EQ(at("pulse triangular 1 2", 0.5, 9.), 0.5);
  EXPECT_EQ(at("  wavelet Ricker 2 1", 1.), 1.);
  EXPECT_DOUBLE_EQ(at("pulse triangular 1 2 times 1e6 * T", 0.5, 3.), 1.5e6);
  const TemporaryDirectory directory;
  write(directory / "t.csv", "0, 0\n1, 5\n");
  const std::string folder = directory.path() + "/";
  EXPECT_DOUBLE_EQ(at("table t.csv times t", 0.5, 0., folder), 1.25);
  EXPECT_DOUBLE_EQ(at("record t.csv integrated once", 1., 0., folder), 2.5);

  // Integrals in closed form, unless something is multiplied.
  EXPECT_TRUE(TimeFunction("wavelet Ricker 2", "./").signal().integral);
  const Signal product
      = TimeFunction("wavelet Ricker 2 1 times 3", "./").signal();
  EXPECT_FALSE(product.integral);
  EXPECT_EQ(product.value(1.), 3.);
  EXPECT_EQ(TimeFunction("t + T", "./").signal().value(2.), 4.);

  EXPECT_NE(message_of<InputError>([] { TimeFunction("pulse", "./"); })
                .find("pulse half-sine"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>(
                [] { TimeFunction("wavelet Ricker 2 times x", "./"); })
                .find("is no expression of t and T"),
            std::string::npos);
}
