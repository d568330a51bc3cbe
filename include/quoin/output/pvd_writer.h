// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_pvd_writer_h
#define quoin_output_pvd_writer_h

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * The series that ParaView opens: a list of VTU files with their times, one
   * entry for each part (rank). The list is part of a checkpoint, so that a
   * resumed run continues it.
   */
  class PvdWriter
  {
  public:
    /** The path is that of the PVD file; its records are relative to it. */
    explicit PvdWriter(const std::string &path) : path(path)
    {
    }

    /** Adds a file of the time @p time [s] without writing the list. */
    void add(const double time, const std::string &file,
             const unsigned int part);

    /** Rewrites the list; the file is complete at any time. @throws RunError */
    void write() const;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &records;
    }

  private:
    struct Record
    {
      double time = 0.;
      std::string file;
      unsigned int part = 0;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &time &file &part;
      }
    };

    std::string path;
    std::vector<Record> records;
  };
} // namespace quoin

#endif
