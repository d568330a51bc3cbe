// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../output/temporary_directory.h"
#include "message_of.h"

#include <quoin/base/exceptions.h>
#include <quoin/base/number_table.h>

#include <fstream>

using namespace quoin;

namespace
{
  std::vector<TableRow> read(const std::string &text)
  {
    const TemporaryDirectory directory;
    std::ofstream(directory / "t.csv") << text;
    return read_number_table(directory / "t.csv", 2, "a time and a value");
  }

  void expect_refused(const std::string &text, const std::string &part)
  {
    const std::string message = message_of<InputError>([&] { read(text); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("t.csv"), std::string::npos) << message;
  }
} // namespace

TEST(NumberTable, HeadingsCommentsAndSeparators)
{
  const auto rows = read("# measured\n\ntime [s],value [m]\n1, -.5\r\n"
                         "# plateau\n2e0\t3 # a remark\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].line, 4U);
  EXPECT_EQ(rows[0].values, (std::vector<double>{ 1., -0.5 }));
  EXPECT_EQ(rows[1].line, 6U);
  EXPECT_EQ(rows[1].values, (std::vector<double>{ 2., 3. }));
}

TEST(NumberTable, AByteOrderMarkIsNoText)
{
  const auto rows = read("\xEF\xBB\xBF"
                         "1, 2\n3, 4\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].values, (std::vector<double>{ 1., 2. }));
}

TEST(NumberTable, ARowWithATypingErrorIsNoHeading)
{
  expect_refused("0;0\n1 2\n", "line 1 of the table");
  expect_refused("time, value\n0, 5m\n1, 2\n", "line 2 of the table");
  expect_refused("0, 1, 2\n", "is not a time and a value");
  expect_refused("0, 1\n2, nan\n", "line 2");
  expect_refused("0, 1\ntime, value\n", "line 2");
  expect_refused("time, value\n", "has no rows");
  EXPECT_NE(
      message_of<InputError>([] { read_number_table("not/there.csv", 2, ""); })
          .find("'not/there.csv' cannot be read"),
      std::string::npos);
}
