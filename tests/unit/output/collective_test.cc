// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/collective.h>

#include <gtest/gtest.h>

#include <stdexcept>

using namespace quoin;

TEST(Collective, ErrorsStayWhatTheyAre)
{
  const auto task = [](const auto &error)
  {
    return [error]()
    { all_or_none<RunError>(MPI_COMM_SELF, [&]() { throw error; }); };
  };
  EXPECT_NO_THROW(all_or_none<RunError>(MPI_COMM_SELF, []() {}));
  EXPECT_THROW(task(InputError("a table is too short"))(), InputError);
  EXPECT_THROW(task(RunError("the disk is full"))(), RunError);
  EXPECT_THROW(task(std::bad_alloc())(), std::bad_alloc);
  // Even one without a word is one.
  EXPECT_THROW(task(std::runtime_error(""))(), RunError);
  try
  {
    all_or_none<InputError>(MPI_COMM_SELF,
                            []() { throw std::logic_error("why"); });
    ADD_FAILURE() << "nothing was thrown";
  }
  catch (const InputError &error)
  {
    EXPECT_STREQ(error.what(), "why");
  }
}
