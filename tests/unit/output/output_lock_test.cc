// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "temporary_directory.h"

#include <quoin/base/exceptions.h>
#include <quoin/output/output_lock.h>

using namespace quoin;

TEST(OutputLock, KeepsOthersOutUntilItEnds)
{
  const TemporaryDirectory directory;
  {
    OutputLock first;
    first.take(directory.path());
    OutputLock second;
    const std::string message
        = message_of<InputError>([&]() { second.take(directory.path()); });
    EXPECT_NE(message.find("another run"), std::string::npos) << message;
    EXPECT_NE(message.find(directory.path()), std::string::npos) << message;
  }
  OutputLock third;
  EXPECT_NO_THROW(third.take(directory.path()));
}

TEST(OutputLock, LeavesComplaintsAboutTheDirectoryToOthers)
{
  const TemporaryDirectory directory;
  OutputLock lock;
  EXPECT_NO_THROW(lock.take(directory / "missing"));
}
