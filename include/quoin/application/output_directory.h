// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_application_output_directory_h
#define quoin_application_output_directory_h

#include <quoin/results/output_lock.h>

#include <string>

namespace quoin
{
  /**
   * Makes the folder @p output and takes its @p lock; if the run does not
   * @p resume another, results of earlier runs go that this one may not write
   * again, and would be taken for its own. Throws an InputError if there can
   * be no such folder, or if another run holds it.
   */
  void take_output(const std::string &output, bool resume, OutputLock &lock);
} // namespace quoin

#endif
