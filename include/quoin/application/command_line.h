// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_application_command_line_h
#define quoin_application_command_line_h

namespace quoin
{
  /**
   * The program quoin. Returns its exit status: 0 finished, 1 wrong input, 2
   * the run failed, 128 and the number of a signal: that has interrupted it.
   */
  int run_command_line(int argc, char **argv);
} // namespace quoin

#endif
