// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_field_series_h
#define quoin_output_field_series_h

#include <quoin/output/field_format.h>
#include <quoin/output/pvd_writer.h>
#include <quoin/output/vtu_writer.h>
#include <quoin/output/xdmf_writer.h>

#include <mpi.h>

#include <quoin/base/packed_vectors.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Fields at several times in the output directory: a series of VTU files
   * fields/<name>_<nnnn>_<rank>.vtu with the list <name>.pvd, or the files of
   * an XdmfWriter. What was written is part of a checkpoint.
   */
  class FieldSeries
  {
  public:
    FieldSeries(const std::string &output_directory, const std::string &name,
                const MPI_Comm communicator, const FieldFormat format);

    /**
     * Collective. Makes the directory and writes an empty series, or after
     * loading a checkpoint that of the checkpoint; what was written later is
     * removed. @throws RunError
     */
    void start();

    unsigned int n_written() const
    {
      return index;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &index &list &xdmf;
    }

  protected:
    /** Collective. Writes the pieces of all ranks. @throws RunError */
    void write_grid(VtuGrid grid);

  private:
    std::string file_name(const unsigned int part) const;

    std::string directory;
    std::string name;
    MPI_Comm communicator;
    FieldFormat format;
    unsigned int rank;
    unsigned int n_ranks;
    unsigned int index = 0;
    PvdWriter list;
    XdmfWriter xdmf;
  };

  /**
   * Removes the series of an earlier run from @p output_directory, of all
   * formats, and all their pieces in fields/. Files of other names and files
   * that cannot be removed stay.
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

  /** The components of vectors, one after the other; also of points. */
  template <typename Vector, int dim = Vector::dimension>
  std::vector<double> flat(const std::vector<Vector> &vectors)
  {
    std::vector<double> result;
    result.reserve(dim * vectors.size());
    for (const dealii::Tensor<1, dim> &vector : vectors)
      append_vector(result, vector);
    return result;
  }
} // namespace quoin

#endif
