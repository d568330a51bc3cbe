// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_root_table_h
#define quoin_results_root_table_h

#include <quoin/results/csv_table.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * A CsvTable of the first rank. Ranks on which it was not made have none, and
   * there its members do nothing: all ranks run the same code. Whatever throws
   * does so on the first rank alone, see all_or_none().
   */
  class RootTable
  {
  public:
    /** To be called on the first rank; see CsvTable. */
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

    /** Goes on with the file as it was at the last sync(). */
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

    /** Before a checkpoint, which holds n_bytes. */
    void sync()
    {
      if (!table)
        return;
      table->sync();
      n_bytes = table->size();
    }

    /** Of the file at the last sync(). */
    std::uint64_t n_bytes = 0;

  private:
    std::unique_ptr<CsvTable> table;
  };
} // namespace quoin

#endif
