// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_base_message_of_h
#define quoin_tests_unit_base_message_of_h

#include <string>

namespace quoin
{
  /** The message of the exception of type @p Error that @p task throws. */
  template <typename Error, typename Task>
  std::string message_of(const Task &task)
  {
    try
    {
      task();
    }
    catch (const Error &error)
    {
      return error.what();
    }
    return "nothing was thrown";
  }
} // namespace quoin

#endif
