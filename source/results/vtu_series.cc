// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/results/atomic_file.h>
#include <quoin/results/collective.h>
#include <quoin/results/vtu_series.h>

#include <cstdio>
#include <filesystem>
#include <regex>
#include <utility>

namespace quoin
{
  VtuSeries::VtuSeries(const std::string &output_directory,
                       const std::string &name, const MPI_Comm communicator)
    : directory(output_directory), name(name), communicator(communicator),
      list(output_directory + "/" + name + ".pvd")
  {
    int mpi_rank, mpi_size;
    MPI_Comm_rank(communicator, &mpi_rank);
    MPI_Comm_size(communicator, &mpi_size);
    rank    = mpi_rank;
    n_ranks = mpi_size;
  }

  void VtuSeries::start()
  {
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (rank == 0)
                            {
                              make_directory(directory + "/fields");
                              list.write();
                            }
                          });
  }

  void VtuSeries::write_grid(VtuGrid grid)
  {
    const double time = grid.time;
    all_or_none<RunError>(
        communicator, [&]()
        { write_vtu(directory + "/" + file_name(rank), std::move(grid)); });
    // Only now, so that the list never names a file that is not there.
    for (unsigned int part = 0; part < n_ranks; ++part)
      list.add(time, file_name(part), part);
    ++index;
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (rank == 0)
                              list.write();
                          });
  }

  std::string VtuSeries::file_name(const unsigned int part) const
  {
    char number[16];
    std::snprintf(number, sizeof(number), "%04u", index);
    return "fields/" + name + "_" + number + "_" + std::to_string(part)
           + ".vtu";
  }

  void remove_series(const std::string &output_directory)
  {
    namespace fs = std::filesystem;
    std::error_code error, ignored;
    for (const char *name :
         { "blocks", "joints", "contacts", "boundary", "field" })
      fs::remove(output_directory + "/" + name + ".pvd", ignored);
    const std::regex piece("(blocks|joints|contacts|boundary|field)"
                           "_[0-9]{4,}_[0-9]+\\.vtu");
    std::vector<fs::path> pieces;
    for (fs::directory_iterator entry(output_directory + "/fields", error);
         !error && entry != fs::directory_iterator(); entry.increment(error))
      if (std::regex_match(entry->path().filename().string(), piece)
          && fs::is_regular_file(entry->symlink_status(ignored)))
        pieces.push_back(entry->path());
    for (const fs::path &path : pieces)
      fs::remove(path, ignored);
  }
} // namespace quoin
