// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_application_output_directory_h
#define quoin_application_output_directory_h

#include <quoin/output/output_lock.h>

#include <string>

namespace quoin
{
  /**
   * Makes the folder @p output and takes its @p lock; if the run does not
   * @p resume another, removes results of earlier runs, which could be taken
   * for its own. Throws an InputError if the folder cannot be made, or if
   * another run holds it.
   */
  void take_output(const std::string &output, bool resume, OutputLock &lock);
} // namespace quoin

#endif
