// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_root_table_h
#define quoin_output_root_table_h

#include <quoin/output/csv_table.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * A CsvTable of the first rank. On other ranks its members do nothing: all
   * ranks run the same code. Exceptions are thrown on the first rank alone, see
   * all_or_none().
   */
  class RootTable
  {
  public:
    /** Creates the table on the first rank; see CsvTable. */
    void make(const std::string &path,
              const std::vector<std::string> &column_names)
    {
      table = std::make_unique<CsvTable>(path, column_names);
    }

    void start()
    {
      if (table)
        table->start();
    }

    /** Continues the file from the last sync(). */
    void resume()
    {
      if (table)
        table->resume(n_bytes);
    }

    void add_row(const std::vector<double> &values)
    {
      if (table)
        table->add_row(values);
    }

    void check() const
    {
      if (table)
        table->check();
    }

    void flush()
    {
      if (table)
        table->flush();
    }

    /** Called before a checkpoint, which has n_bytes. */
    void sync()
    {
      if (!table)
        return;
      table->sync();
      n_bytes = table->size();
    }

    /** Size of the file at the last sync() [bytes]. */
    std::uint64_t n_bytes = 0;

  private:
    std::unique_ptr<CsvTable> table;
  };
} // namespace quoin

#endif
