// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_collective_h
#define quoin_output_collective_h

#include <quoin/base/exceptions.h>

#include <mpi.h>

#include <new>
#include <string>

namespace quoin
{
  /**
   * Collective: the message of the lowest rank that has one, on all ranks;
   * empty if none has. A failure on one rank must be thrown on all, or the
   * others wait forever.
   */
  std::string first_message(const MPI_Comm communicator,
                            const std::string &message);

  /**
   * Collective: runs @p task on every rank and throws on all of them the
   * exception of the lowest rank that failed: an InputError, a RunError or a
   * std::bad_alloc as such, anything else as an @p Error.
   */
  template <typename Error, typename Task>
  void all_or_none(const MPI_Comm communicator, const Task &task)
  {
    std::string message; // its first letter is the type
    try
    {
      task();
    }
    catch (const InputError &error)
    {
      message = std::string("I") + error.what();
    }
    catch (const RunError &error)
    {
      message = std::string("R") + error.what();
    }
    catch (const std::bad_alloc &)
    {
      message = "M";
    }
    catch (const std::exception &error)
    {
      message = std::string("E") + error.what();
    }
    message = first_message(communicator, message);
    if (message.empty())
      return;
    const std::string text = message.substr(1);
    switch (message.front())
    {
    case 'I':
      throw InputError(text);
    case 'R':
      throw RunError(text);
    case 'M':
      throw std::bad_alloc();
    default:
      throw Error(text);
    }
  }
} // namespace quoin

#endif
