// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_collective_h
#define quoin_output_collective_h

#include <mpi.h>

#include <string>

namespace quoin
{
  /**
   * Collective: the message of the lowest rank that has one, on all ranks;
   * empty if none has. A failure of one rank must be everybody's, or the
   * others wait for it forever.
   */
  std::string first_message(const MPI_Comm communicator,
                            const std::string &message);

  /**
   * Collective: runs @p task on every rank and throws on all of them what one
   * of them threw, as an @p Error.
   */
  template <typename Error, typename Task>
  void all_or_none(const MPI_Comm communicator, const Task &task)
  {
    std::string message;
    try
    {
      task();
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    message = first_message(communicator, message);
    if (!message.empty())
      throw Error(message);
  }
} // namespace quoin

#endif
