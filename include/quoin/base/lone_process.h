// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_lone_process_h
#define quoin_base_lone_process_h

#include <cstdlib>

namespace quoin
{
  /**
   * Switches off what Open MPI does not need in a process started without
   * mpirun, before MPI_Init(): the daemon for spawned processes and session
   * folders among the temporary files. Such processes share folder names, so
   * that one that ends may remove them while another starts, whose MPI_Init()
   * then fails. Open MPI's handlers of crash signals are switched off for all
   * processes: their report allocates memory, which may hang if memory is
   * corrupted.
   */
  inline void prepare_lone_process()
  {
    setenv("OMPI_MCA_opal_signal", "", 0);
    if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr)
      return; // started by mpirun
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
} // namespace quoin

#endif
