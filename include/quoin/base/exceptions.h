// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_exceptions_h
#define quoin_base_exceptions_h

#include <stdexcept>
#include <string>

namespace quoin
{
  /**
   * Wrong input. The message names the file, section, value and cure; the
   * program prints it and ends with exit status 1 before anything is
   * computed.
   */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A run that cannot continue (instability, full disk). The message says
   * where, when and what to try; the program ends with exit status 2 and keeps
   * the last checkpoint and all output.
   */
  class RunError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A RunError about the model and not the machine, thrown by all ranks: there
   * is no equilibrium, a block has left the box. In a search for a factor of
   * safety it means that the trial is unstable.
   */
  class ModelFailure : public RunError
  {
  public:
    using RunError::RunError;
  };

  /** Returns the result of @p task and puts the name of the parameter file
      before its InputErrors. */
  template <typename Task>
  auto naming(const std::string &file, const Task &task)
  {
    try
    {
      return task();
    }
    catch (const InputError &error)
    {
      throw InputError(file + ", " + error.what());
    }
  }
} // namespace quoin

#endif
