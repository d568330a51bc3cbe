// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_application_open_log_h
#define quoin_application_open_log_h

#include <quoin/application/parameters.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/collective.h>
#include <quoin/output/log.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>

namespace quoin
{
  /**
   * Makes the folder @p output and begins the log of a run, or goes on with
   * that of the run which @p record is read from, its last checkpoint.
   * Collective. Throws an InputError if the folder cannot be made or there is
   * no such checkpoint.
   */
  template <typename Record>
  void open_log(const Parameters &parameters, const std::string &output,
                const bool resume, const MPI_Comm communicator, Log &log,
                Record &record)
  {
    all_or_none<InputError>(
        communicator,
        [&]()
        {
          std::error_code error;
          if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
            return;
          std::filesystem::create_directories(output, error);
          if (!std::filesystem::is_directory(output))
            throw InputError("the output directory '" + output
                             + "' cannot be made: " + error.message()
                             + ". Choose another with 'Output directory' or "
                               "--output.");
        });
    CheckpointInfo info;
    if (resume)
      info = load_checkpoint(output, communicator, QUOIN_VERSION,
                             fingerprint(parameters.effective), record);
    all_or_none<RunError>(communicator,
                          [&]() { log.open(output + "/log.txt", resume); });
    if (resume)
      log.message("resumed at time " + number_text(info.time) + " s, step "
                  + std::to_string(info.step));
  }
} // namespace quoin

#endif
