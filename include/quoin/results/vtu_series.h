// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_vtu_series_h
#define quoin_results_vtu_series_h

#include <quoin/results/pvd_writer.h>
#include <quoin/results/vtu_writer.h>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * A series of VTU files fields/<name>_<nnnn>_<rank>.vtu and its list
   * <name>.pvd in the output directory. Its number and list are part of a
   * checkpoint.
   */
  class VtuSeries
  {
  public:
    VtuSeries(const std::string &output_directory, const std::string &name,
              const MPI_Comm communicator);

    /**
     * Collective. Makes the directory and writes the list: an empty one, or
     * after loading a checkpoint the list of the checkpoint; pieces written
     * later are removed. @throws RunError
     */
    void start();

    unsigned int n_written() const
    {
      return index;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &index &list;
    }

  protected:
    /** Collective. Writes one piece for each rank. @throws RunError */
    void write_grid(VtuGrid grid);

  private:
    std::string file_name(const unsigned int part) const;

    std::string directory;
    std::string name;
    MPI_Comm communicator;
    unsigned int rank;
    unsigned int n_ranks;
    unsigned int index = 0;
    PvdWriter list;
  };

  /**
   * Removes the series of an earlier run from @p output_directory: their lists
   * and all their pieces in fields/. Files of other names and files that cannot
   * be removed stay.
   */
  void remove_series(const std::string &output_directory);

  /** Two or more components for each entry, one after the other. */
  template <typename T, std::size_t n>
  std::vector<T> flat(const std::vector<std::array<T, n>> &entries)
  {
    std::vector<T> result;
    result.reserve(n * entries.size());
    for (const std::array<T, n> &entry : entries)
      result.insert(result.end(), entry.begin(), entry.end());
    return result;
  }
} // namespace quoin

#endif
