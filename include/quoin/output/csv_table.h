// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_csv_table_h
#define quoin_output_csv_table_h

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  class FileBuffer;

  /** The shortest decimal text that reads back as exactly this number. */
  std::string shortest_text(const double value);

  /**
   * A comma separated table under one header row, written row by row through
   * a buffer. A checkpoint notes size(), and a resumed run cuts the table to
   * that size, so that rows written after the checkpoint do not appear twice.
   *
   * Members throw RunError, which names the file, if it cannot be written;
   * except add_row(), because only one rank has the table and the others would
   * wait for it: check(), flush() and sync() report its failures.
   */
  class CsvTable
  {
  public:
    /** Stores its arguments; start() creates the file or resume() opens it. */
    CsvTable(const std::string &path,
             const std::vector<std::string> &column_names);
    ~CsvTable();

    /** Creates the file with its header row; an older one is replaced. */
    void start();

    /**
     * Continues the file of an interrupted run, cut to @p n_bytes. @throws
     * InputError if the file is shorter than that, is missing, or has other
     * columns
     */
    void resume(const std::uint64_t n_bytes);

    /** Adds a row, one value for each column. See check(). */
    void add_row(const std::vector<double> &values);

    /** @throws RunError if a row so far could not be written */
    void check() const;

    /** Hands the rows to the system, so that other programs see them. */
    void flush();

    /** Does what flush() does and waits for the disk; called before a
     * checkpoint. */
    void sync();

    /** Bytes of the table so far, buffered ones included. */
    std::uint64_t size() const;

  private:
    std::string path;
    std::string header;
    unsigned int n_columns;
    std::uint64_t size_at_opening = 0;
    std::unique_ptr<FileBuffer> buffer;
  };
} // namespace quoin

#endif
