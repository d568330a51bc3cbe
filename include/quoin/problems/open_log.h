// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_open_log_h
#define quoin_problems_open_log_h

#include <quoin/problems/parameters.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/mesh/mesh_data.h>
#include <quoin/results/checkpoint.h>
#include <quoin/results/collective.h>
#include <quoin/results/log.h>
#include <quoin/results/output_lock.h>

#include <string>

namespace quoin
{
  /**
   * What a run must have in common with the one that it resumes: a
   * fingerprint() of all parameters, of the mesh as it was read or generated,
   * and of the files of tables and records.
   */
  std::string run_fingerprint(const Parameters &parameters,
                              const MeshData &mesh);

  /**
   * Makes the folder @p output and takes its @p lock; if the run does not
   * @p resume another, results of earlier runs go that this one may not write
   * again, and would be taken for its own. Throws an InputError if there can
   * be no such folder, or if another run holds it.
   */
  void take_output(const std::string &output, bool resume, OutputLock &lock);

  /**
   * Takes the folder @p output, see take_output(), and begins the log of a
   * run, or goes on with that of the run which @p record is read from, its last
   * checkpoint, whose @p fingerprint must be the same. Collective. Throws an
   * InputError if the folder cannot be had or there is no such checkpoint.
   */
  template <typename Record>
  void open_log(const std::string &fingerprint, const std::string &output,
                const bool resume, const MPI_Comm communicator,
                OutputLock &lock, Log &log, Record &record)
  {
    all_or_none<InputError>(communicator,
                            [&]()
                            {
                              int rank;
                              MPI_Comm_rank(communicator, &rank);
                              if (rank == 0)
                                take_output(output, resume, lock);
                            });
    CheckpointInfo info;
    if (resume)
      info = load_checkpoint(output, communicator, QUOIN_VERSION, fingerprint,
                             record);
    all_or_none<RunError>(communicator,
                          [&]() { log.open(output + "/log.txt", resume); });
    if (resume)
      log.message("resumed at time " + number_text(info.time) + " s, step "
                  + std::to_string(info.step));
  }
} // namespace quoin

#endif
