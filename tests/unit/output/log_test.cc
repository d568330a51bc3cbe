// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "temporary_directory.h"

#include <quoin/base/exceptions.h>
#include <quoin/output/log.h>
#include <quoin/output/progress.h>

using namespace quoin;

TEST(Log, TheFileGetsAllMessages)
{
  const TemporaryDirectory directory;
  testing::internal::CaptureStdout();
  {
    Log log(true, true);
    log.message("before the file");
    log.open(directory / "log.txt", false);
    log.message("after");
    log.warning("dt is large");
  }
  {
    Log log(true, false);
    log.open(directory / "log.txt", true);
    log.message("resumed");
  }
  EXPECT_EQ(contents(directory / "log.txt"),
            "before the file\nafter\nWarning: dt is large\nresumed\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "Warning: dt is large\nresumed\n");
}

TEST(Log, OtherRanksAreSilent)
{
  const TemporaryDirectory directory;
  testing::internal::CaptureStdout();
  Log log(false, false);
  log.open(directory / "log.txt", false);
  log.message("text");
  log.warning("text");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_FALSE(std::filesystem::exists(directory / "log.txt"));
  EXPECT_FALSE(Progress(log).due());
}

TEST(Log, UnwritableDirectory)
{
  const TemporaryDirectory directory;
  std::ofstream(directory / "file") << "not a directory";
  Log log(true, true);
  EXPECT_THROW(log.open(directory / "file/log.txt", false), RunError);
}

TEST(Progress, ALineWhenOneIsDue)
{
  testing::internal::CaptureStdout();
  Log log(true, false);
  Progress hourly(log, 3600.);
  Progress always(log, 0.);
  ProgressFigures figures;
  figures.stage    = "shear";
  figures.fraction = 0.;
  hourly.start(figures);
  always.start(figures);
  EXPECT_FALSE(hourly.due());
  EXPECT_TRUE(always.due());
  figures.time             = 0.25;
  figures.step             = 1000;
  figures.fraction         = 0.5;
  figures.unbalanced_ratio = 1e-4;
  hourly.update(figures);
  always.update(figures);
  const std::string line = testing::internal::GetCapturedStdout();
  EXPECT_EQ(line.find("shear: 50.0%, t = 0.25 s, step 1000, 0 s to go, "), 0U)
      << line;
  EXPECT_NE(line.find("unbalanced 0.0001"), std::string::npos) << line;
  EXPECT_EQ(line.find("critical"), std::string::npos) << line;
  EXPECT_EQ(line.find("nan"), std::string::npos) << line;
}

TEST(Progress, Durations)
{
  EXPECT_EQ(duration_text(12.4), "12 s");
  EXPECT_EQ(duration_text(185.), "3:05 min");
  EXPECT_EQ(duration_text(7620.), "2:07 h");
  EXPECT_EQ(duration_text(3.5 * 86400), "3.5 days");
}
