// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/collective.h>
#include <quoin/output/field_series.h>

#include <cstdio>
#include <filesystem>
#include <regex>
#include <utility>

namespace quoin
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Removes the files in @p folder whose name is a regular expression with
        a number in parentheses, of at least @p first. */
    void remove_files(const std::string &folder, const std::string &expression,
                      const unsigned int first = 0)
    {
      std::error_code error, ignored;
      const std::regex wanted(expression);
      std::vector<fs::path> files;
      std::smatch match;
      for (fs::directory_iterator entry(folder, error);
           !error && entry != fs::directory_iterator(); entry.increment(error))
        if (const std::string name = entry->path().filename().string();
            std::regex_match(name, match, wanted)
            && (first == 0 || std::stoul(match[1]) >= first)
            && fs::is_regular_file(entry->symlink_status(ignored)))
          files.push_back(entry->path());
      for (const fs::path &file : files)
        fs::remove(file, ignored);
    }

    /** Names of the pieces in fields/ of the series @p names. */
    std::string pieces_of(const std::string &names)
    {
      return "(?:" + names + ")_([0-9]{4,9})_[0-9]+\\.vtu";
    }
  } // namespace

  FieldSeries::FieldSeries(const std::string &output_directory,
                           const std::string &name, const MPI_Comm communicator,
                           const FieldFormat format)
    : directory(output_directory), name(name), communicator(communicator),
      format(format), list(output_directory + "/" + name + ".pvd"),
      xdmf(output_directory, name, communicator)
  {
    int mpi_rank, mpi_size;
    MPI_Comm_rank(communicator, &mpi_rank);
    MPI_Comm_size(communicator, &mpi_size);
    rank    = mpi_rank;
    n_ranks = mpi_size;
  }

  void FieldSeries::start()
  {
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (rank != 0)
                              return;
                            const std::string fields = directory + "/fields";
                            if (format == FieldFormat::xdmf)
                            {
                              make_directory(directory);
                              xdmf.start();
                              return;
                            }
                            make_directory(fields);
                            list.write();
                            // Pieces of more ranks would remain.
                            remove_files(fields, pieces_of(name), index);
                          });
  }

  void FieldSeries::write_grid(VtuGrid grid)
  {
    if (format == FieldFormat::xdmf)
    {
      xdmf.write(std::move(grid));
      ++index;
      return;
    }
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

  std::string FieldSeries::file_name(const unsigned int part) const
  {
    char number[16];
    std::snprintf(number, sizeof(number), "%04u", index);
    return "fields/" + name + "_" + number + "_" + std::to_string(part)
           + ".vtu";
  }

  void remove_series(const std::string &output_directory)
  {
    const std::string names
        = "blocks|joints|contacts|cables|beams|boundary|field";
    remove_files(output_directory,
                 "(?:" + names + ")(?:\\.pvd|\\.xdmf|(?:_[0-9]+)?\\.bin)");
    remove_files(output_directory + "/fields", pieces_of(names));
  }
} // namespace quoin
