// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_xdmf_writer_h
#define quoin_output_xdmf_writer_h

#include <quoin/output/vtu_writer.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <mpi.h>

#include <cstdint>
#include <map>
#include <string>

namespace quoin
{
  /**
   * Grids of all times and ranks in two files: NAME.xdmf says what lies where
   * in NAME.bin, in the format XDMF 2 (https://www.xdmf.org) with raw little
   * endian data, which both readers of ParaView take. A temporal collection has
   * a spatial one for each time, and this a grid for each rank that has cells.
   *
   * An array that has not changed since the last time is not written again: the
   * mesh, numbers of blocks. Both files are readable after each write(). Their
   * lengths are part of a checkpoint: a resumed run truncates the files to them
   * and continues.
   */
  class XdmfWriter
  {
  public:
    /** @p directory must exist before start(). */
    XdmfWriter(const std::string &directory, const std::string &name,
               const MPI_Comm communicator);

    /**
     * On the first rank: begins the files, or cuts them back to those of the
     * checkpoint. @throws RunError if they cannot be written, InputError if
     * they are not those of the checkpoint
     */
    void start();

    /** Collective. Adds a time, of a grid on each rank. @throws RunError */
    void write(VtuGrid grid);

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &text_size &file_number &data_size &places;
    }

  private:
    /** Hash, size and offset of an array in the data file. */
    struct Place
    {
      std::uint64_t hash = 0, size = 0, offset = 0;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &hash &size &offset;
      }
    };

    std::string data_file(const unsigned int number) const;
    void write_text_end(const std::string &text);

    std::string directory;
    std::string name;
    MPI_Comm communicator;
    bool is_first;

    std::uint64_t text_size = 0; /**< without closing tags; on first rank [B] */
    unsigned int file_number = 0;
    std::uint64_t data_size  = 0; /**< size of the last data file [B] */
    /** Places of this rank's last arrays. */
    std::map<std::string, Place> places;
  };
} // namespace quoin

#endif
