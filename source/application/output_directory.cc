// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/output_directory.h>
#include <quoin/base/exceptions.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/field_series.h>

#include <filesystem>

namespace quoin
{
  void take_output(const std::string &output, const bool resume,
                   OutputLock &lock)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    if (resume && !fs::exists(output, error))
      throw InputError("There is no checkpoint in '" + output
                       + "' to resume from, nor such a folder: check --output, "
                         "or start the run without --resume.");
    fs::create_directories(output, error);
    std::error_code ignored;
    if (!fs::is_directory(output, ignored))
      throw InputError(
          "the output directory '" + output + "' cannot be made: "
          + (error ? error.message() : "there is a file of this name")
          + ". Choose another with 'Output directory' or --output.");
    lock.take(output);
    if (resume)
      return;
    remove_checkpoint(output);
    for (const char *name :
         { "summary.json", "histories.csv", "energies.csv", "safety.csv",
           "convergence.csv", "far_field.csv", "flow.csv", "blocks_outside.csv",
           "rock_statistics.csv" })
      fs::remove(output + "/" + name, error);
    remove_series(output);
    remove_series(output + "/mechanism");
  }
} // namespace quoin
