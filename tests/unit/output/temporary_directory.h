// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_output_temporary_directory_h
#define quoin_tests_unit_output_temporary_directory_h

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace quoin
{
  /** An empty directory for the files of one test, removed at its end. */
  class TemporaryDirectory
  {
  public:
    TemporaryDirectory()
    {
      const auto *test = testing::UnitTest::GetInstance()->current_test_info();
      directory        = std::filesystem::temp_directory_path()
                  / ("quoin_" + std::string(test->test_suite_name()) + "_"
                     + test->name() + "_" + std::to_string(::getpid()));
      std::filesystem::remove_all(directory);
      std::filesystem::create_directories(directory);
    }

    ~TemporaryDirectory()
    {
      std::error_code error;
      std::filesystem::remove_all(directory, error);
    }

    std::string operator/(const std::string &name) const
    {
      return (directory / name).string();
    }

    std::string path() const
    {
      return directory.string();
    }

  private:
    std::filesystem::path directory;
  };

  inline std::string contents(const std::string &path)
  {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
} // namespace quoin

#endif
