// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_interruption_h
#define quoin_results_interruption_h

#include <string>

namespace quoin
{
  /**
   * While one of these lives, SIGINT, SIGTERM and SIGUSR1, which mpirun passes
   * on, ask the run to end where it can be resumed, instead of ending the
   * process. A second signal ends it at once, unless it comes within a tenth of
   * a second: shells and batch systems send the first one to a process and to
   * its group. There is one of these at a time.
   */
  class Interruption
  {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption &)            = delete;
    Interruption &operator=(const Interruption &) = delete;

    /** The number of the signal that this process has received; 0: none. */
    static int received();
  };

  /** "SIGINT" */
  std::string signal_name(int number);
} // namespace quoin

#endif
