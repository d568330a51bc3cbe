// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_run_options_h
#define quoin_problems_run_options_h

namespace quoin
{
  /** What the command line adds to the parameter file. */
  struct RunOptions
  {
    bool resume = false;
    bool check  = false; /**< report and stop before the first step */
    bool quiet  = false;
  };
} // namespace quoin

#endif
