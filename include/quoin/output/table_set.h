// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_table_set_h
#define quoin_output_table_set_h

#include <quoin/output/collective.h>
#include <quoin/output/root_table.h>

#include <deque>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * All tables of a run, which are created, continued and synchronised
   * together. Collective members throw a RunError on all ranks.
   */
  class TableSet
  {
  public:
    /** @p folder of the files, which need not exist yet. */
    TableSet(const std::string &folder, const MPI_Comm communicator)
      : folder(folder), communicator(communicator)
    {
      MPI_Comm_rank(communicator, &rank);
    }

    /** The table @p file; the reference stays valid. */
    RootTable &add(const std::string &file,
                   const std::vector<std::string> &column_names)
    {
      tables.emplace_back();
      if (rank == 0)
        tables.back().make(folder + "/" + file, column_names);
      return tables.back();
    }

    /** Creates or continues the files; collective. */
    void open(const bool resume)
    {
      for_all([=](RootTable &table)
              { resume ? table.resume() : table.start(); });
    }

    /** Collective: stops all ranks if a row could not be written. */
    void check()
    {
      for_all([](RootTable &table) { table.check(); });
    }

    /** Collective. */
    void flush()
    {
      for_all([](RootTable &table) { table.flush(); });
    }

    /** Called before a checkpoint; collective. */
    void sync()
    {
      for_all([](RootTable &table) { table.sync(); });
    }

    /** Archives the sizes of the files; tables must have been added before. */
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      for (RootTable &table : tables)
        archive &table.n_bytes;
    }

  private:
    template <typename Task>
    void for_all(const Task &task)
    {
      all_or_none<RunError>(communicator,
                            [&]()
                            {
                              for (RootTable &table : tables)
                                task(table);
                            });
    }

    const std::string folder;
    const MPI_Comm communicator;
    int rank = 0;
    std::deque<RootTable> tables;
  };
} // namespace quoin

#endif
