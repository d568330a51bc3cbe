// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_interruption_h
#define quoin_output_interruption_h

#include <string>

namespace quoin
{
  /**
   * While one of these lives, it answers SIGINT, SIGTERM and SIGUSR1, which
   * mpirun passes on. Before the steps they end the process, with a line of the
   * first rank: there is nothing to keep. From then on they ask the run to end
   * where it can be resumed. A second signal ends it at once, unless it comes
   * within half a second: shells and batch systems send the first one to a
   * process and to its group, and mpirun passes it on several times. There is
   * one of these at a time.
   */
  class Interruption
  {
  public:
    explicit Interruption(bool is_first_rank);
    ~Interruption();
    Interruption(const Interruption &)            = delete;
    Interruption &operator=(const Interruption &) = delete;

    /** Begins the part of the run that ends itself when it has received() a
     * signal. */
    static void begin_steps();

    /** The number of the signal that this process has received since the steps
        began; 0: none. */
    static int received();
  };

  /** "SIGINT" */
  std::string signal_name(int number);
} // namespace quoin

#endif
