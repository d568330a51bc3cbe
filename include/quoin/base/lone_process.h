// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_lone_process_h
#define quoin_base_lone_process_h

#include <cstdlib>

namespace quoin
{
  /**
   * Spares Open MPI what a process started without mpirun does not need, to be
   * called before MPI_Init(): a daemon beside it, in case that it spawned
   * others, and folders in the folder for temporary files. Lone processes share
   * their names there, so that one which ends may remove them while another
   * begins, whose MPI_Init() then fails. Of no process does Open MPI catch the
   * signals of a crash: its report asks for memory, which where memory is
   * damaged never ends.
   */
  inline void prepare_lone_process()
  {
    setenv("OMPI_MCA_opal_signal", "", 0);
    if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr)
      return; // one of mpirun
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
} // namespace quoin

#endif
