// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_interruption_h
#define quoin_output_interruption_h

#include <string>

namespace quoin
{
  /**
   * Answers SIGINT, SIGTERM and SIGUSR1, which mpirun passes on, until the
   * process ends. Before the steps the first rank ends itself, with a line, and
   * so the others: there is nothing to keep. From then on the run is asked to
   * end where it can be resumed. A second signal ends the process at once,
   * unless it comes within half a second: shells and batch systems send the
   * first one to a process and to its group, and mpirun passes it on several
   * times.
   */
  struct Interruption
  {
    /** From now on signals are answered. */
    static void begin(bool is_first_rank);

    /** Begins the part of the run that ends itself when it has received() a
        signal. The other ranks note signals before it as well: they reach it
        later than the first one, which may have begun to step by then. */
    static void begin_steps();

    /** The number of the signal that this process is to end by where it can be
        resumed; 0: none. */
    static int received();
  };

  /** "SIGINT" */
  std::string signal_name(int number);
} // namespace quoin

#endif
