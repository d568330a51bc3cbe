// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../output/temporary_directory.h"

#include <quoin/application/output_directory.h>

#include <set>

using namespace quoin;

namespace
{
  void make_files(const TemporaryDirectory &directory,
                  const std::set<std::string> &names)
  {
    for (const std::string &name : names)
    {
      const std::filesystem::path path(directory / name);
      std::filesystem::create_directories(path.parent_path());
      std::ofstream(path) << "old\n";
    }
  }

  std::set<std::string> files_in(const TemporaryDirectory &directory)
  {
    namespace fs = std::filesystem;
    std::set<std::string> names;
    for (const fs::directory_entry &entry :
         fs::recursive_directory_iterator(directory.path()))
      if (entry.is_regular_file() && entry.path().filename() != "lock")
        names.insert(fs::relative(entry.path(), directory.path()).string());
    return names;
  }

  const std::set<std::string> results
      = { "summary.json",
          "far_field.csv",
          "flow.csv",
          "blocks_outside.csv",
          "beams.pvd",
          "beams.xdmf",
          "fields/beams_0003_0.vtu",
          "mechanism/beams.pvd",
          "blocks.pvd",
          "field.pvd",
          "contacts.xdmf",
          "contacts.bin",
          "boundary_12.bin",
          "fields/blocks_0000_0.vtu",
          "fields/blocks_0000_13.vtu",
          "fields/joints_0107_0.vtu",
          "fields/contacts_10000_1.vtu",
          "fields/boundary_0002_0.vtu",
          "fields/field_0000_0.vtu",
          "mechanism/joints.pvd",
          "mechanism/fields/joints_0000_0.vtu" };

  const std::set<std::string> others = { "notes.txt",
                                         "my_blocks.bin",
                                         "blocks_a.bin",
                                         "results.xdmf",
                                         "blocks_0000_0.vtu",
                                         "fields/blocks_0000_0.vtu.bak",
                                         "fields/blocks_0_0.vtu",
                                         "fields/my_blocks_0000_0.vtu",
                                         "fields/blocks.vtu",
                                         "fields/blocks_0000_0.vtu.d/x" };
} // namespace

TEST(TakeOutput, RemovesResultsOfAnEarlierRunAndNothingElse)
{
  const TemporaryDirectory directory;
  make_files(directory, results);
  make_files(directory, others);
  OutputLock lock;
  take_output(directory.path(), false, lock);
  EXPECT_EQ(files_in(directory), others);
}

TEST(TakeOutput, KeepsAllForAResumedRun)
{
  const TemporaryDirectory directory;
  make_files(directory, results);
  OutputLock lock;
  take_output(directory.path(), true, lock);
  EXPECT_EQ(files_in(directory), results);
}
