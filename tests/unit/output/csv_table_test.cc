// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "temporary_directory.h"

#include <quoin/base/exceptions.h>
#include <quoin/output/csv_table.h>
#include <quoin/output/root_table.h>

#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <limits>

using namespace quoin;

namespace
{
  const std::vector<std::string> columns = { "time [s]", "ux [m]" };
}

TEST(CsvTable, NumbersReadBackExactly)
{
  for (const double value :
       { 0., 1., 0.1, 1. / 3., -1e-300, 6.02214076e23, 5e-324 })
    EXPECT_EQ(std::strtod(shortest_text(value).c_str(), nullptr), value);
  EXPECT_EQ(shortest_text(0.1), "0.1");
  EXPECT_EQ(shortest_text(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(CsvTable, HeaderAndRows)
{
  const TemporaryDirectory directory;
  CsvTable table(directory / "h.csv", columns);
  table.start();
  table.add_row({ 0., 0.1 });
  table.add_row({ 1e-3, -2.5 });
  table.add_row({ 1234567.875, 0.10000000000000002 });
  table.flush();
  const std::string expected = "time [s],ux [m]\n0,0.1\n0.001,-2.5\n"
                               "1234567.875,0.10000000000000002\n";
  EXPECT_EQ(contents(directory / "h.csv"), expected);
  EXPECT_EQ(table.size(), expected.size());
  EXPECT_THROW(table.add_row({ 1. }), std::logic_error);
}

TEST(CsvTable, AResumedRunForgetsWhatCameAfterTheCheckpoint)
{
  const TemporaryDirectory directory;
  const std::string path = directory / "h.csv";
  std::uint64_t size     = 0;
  {
    CsvTable table(path, columns);
    table.start();
    table.add_row({ 0., 1. });
    table.sync();
    size = table.size();
    table.add_row({ 1., 2. });
    table.add_row({ 2., 3. });
  }
  EXPECT_GT(std::filesystem::file_size(path), size);

  CsvTable table(path, columns);
  table.resume(size);
  EXPECT_EQ(table.size(), size);
  table.add_row({ 1., 7. });
  table.flush();
  EXPECT_EQ(contents(path), "time [s],ux [m]\n0,1\n1,7\n");
  EXPECT_EQ(table.size(), std::filesystem::file_size(path));
}

TEST(CsvTable, ATableThatDoesNotBelongToTheRunIsRefused)
{
  const TemporaryDirectory directory;
  const std::string path = directory / "h.csv";
  CsvTable table(path, columns);
  EXPECT_NE(
      message_of<InputError>([&]() { table.resume(1); }).find("cannot be read"),
      std::string::npos);
  table.start();
  EXPECT_NE(
      message_of<InputError>([&]() { table.resume(10000); }).find("is shorter"),
      std::string::npos);
  CsvTable other(path, { "time [s]", "uy [m]" });
  EXPECT_NE(message_of<InputError>([&]() { other.resume(5); })
                .find("has other columns"),
            std::string::npos);
}

TEST(CsvTable, UnwritableDirectory)
{
  const TemporaryDirectory directory;
  std::ofstream(directory / "file") << "not a directory";
  CsvTable table(directory / "file/h.csv", columns);
  EXPECT_THROW(table.start(), RunError);
}

TEST(CsvTable, FullDisk)
{
  const TemporaryDirectory directory;
  std::filesystem::create_symlink("/dev/full", directory / "h.csv");
  CsvTable table(directory / "h.csv", columns);
  const std::string message = message_of<RunError>([&]() { table.start(); });
  EXPECT_NE(message.find("h.csv"), std::string::npos) << message;
  EXPECT_NE(message.find("Free some space"), std::string::npos) << message;
}

TEST(CsvTable, RowsThatDoNotFitAreFoundLater)
{
  // Only one rank has the table: adding a row must not stop it alone.
  const TemporaryDirectory directory;
  CsvTable table(directory / "h.csv", columns);
  table.start();
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{ 1000, before.rlim_max };
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  for (unsigned int i = 0; i < 30000; ++i)
    table.add_row({ 1. / (i + 3.), 2. / (i + 7.) });
  const std::string message = message_of<RunError>([&]() { table.check(); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find("h.csv"), std::string::npos) << message;
}

TEST(RootTable, GoesOnFromItsLastSync)
{
  const TemporaryDirectory directory;
  RootTable before;
  before.make(directory / "h.csv", columns);
  before.start();
  before.add_row({ 0., 1. });
  before.sync();
  before.add_row({ 1., 2. });
  before.flush();

  RootTable after;
  after.make(directory / "h.csv", columns);
  after.n_bytes = before.n_bytes;
  after.resume();
  after.add_row({ 1., 7. });
  after.flush();
  EXPECT_EQ(contents(directory / "h.csv"), "time [s],ux [m]\n0,1\n1,7\n");
}

TEST(RootTable, DoesNothingWhereItWasNotMade)
{
  RootTable table;
  table.start();
  table.add_row({ 0. });
  table.check();
  table.flush();
  table.sync();
  EXPECT_EQ(table.n_bytes, 0U);
  table.resume();
}
