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
  namespace
  {
    namespace fs = std::filesystem;

    /** Removes the pieces in fields/ of the series @p names, a regular
        expression, that have the number @p first or a later one. */
    void remove_pieces(const std::string &output_directory,
                       const std::string &names, const unsigned int first)
    {
      std::error_code error, ignored;
      const std::regex piece("(" + names + ")_([0-9]{4,9})_[0-9]+\\.vtu");
      std::vector<fs::path> pieces;
      std::smatch match;
      for (fs::directory_iterator entry(output_directory + "/fields", error);
           !error && entry != fs::directory_iterator(); entry.increment(error))
        if (const std::string name = entry->path().filename().string();
            std::regex_match(name, match, piece)
            && std::stoul(match[2]) >= first
            && fs::is_regular_file(entry->symlink_status(ignored)))
          pieces.push_back(entry->path());
      for (const fs::path &path : pieces)
        fs::remove(path, ignored);
    }
  } // namespace

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
                              // Pieces of more ranks would remain.
                              remove_pieces(directory, name, index);
                            }
                          });
  }

  void VtuSeries::write_grid(VtuGrid grid)
  {
    const double time = grid.time;
    all_or_none<RunError>(
        communicator, [&]()
        { write_vtu(directory + "/" + file_name(rank), std::move(grid)); });
    // Added only now, so that the list never names a missing file.
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
    std::error_code ignored;
    for (const char *name :
         { "blocks", "joints", "contacts", "boundary", "field" })
      fs::remove(output_directory + "/" + name + ".pvd", ignored);
    remove_pieces(output_directory, "blocks|joints|contacts|boundary|field", 0);
  }
} // namespace quoin
