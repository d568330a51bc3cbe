// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/collective.h>

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

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

// On any number of ranks: what fails on one of them fails on all.
TEST(Collective, TheFailureOfOneRankIsThatOfAll)
{
  int rank, n_ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  for (int failing = 0; failing < n_ranks; ++failing)
  {
    std::string heard;
    try
    {
      all_or_none<RunError>(MPI_COMM_WORLD,
                            [&]()
                            {
                              if (rank == failing)
                                throw InputError("of rank "
                                                 + std::to_string(rank));
                            });
    }
    catch (const InputError &error)
    {
      heard = error.what();
    }
    EXPECT_EQ(heard, "of rank " + std::to_string(failing));
  }
  // Of several messages that of the lowest rank is heard.
  EXPECT_EQ(first_message(MPI_COMM_WORLD, std::to_string(rank)), "0");
  EXPECT_EQ(first_message(MPI_COMM_WORLD, ""), "");
}
