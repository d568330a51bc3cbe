// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/csv_table.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace quoin
{
  std::string shortest_text(const double value)
  {
    char text[32];
    const std::to_chars_result end
        = std::to_chars(text, text + sizeof(text), value);
    return std::string(text, end.ptr);
  }

  CsvTable::CsvTable(const std::string &path,
                     const std::vector<std::string> &column_names)
    : path(path), n_columns(column_names.size())
  {
    for (const std::string &name : column_names)
      header += (header.empty() ? "" : ",") + name;
    header += "\n";
  }

  CsvTable::~CsvTable() = default;

  void CsvTable::start()
  {
    buffer          = std::make_unique<FileBuffer>(path);
    size_at_opening = 0;
    check();
    buffer->sputn(header.data(), header.size());
    flush();
  }

  void CsvTable::resume(const std::uint64_t n_bytes)
  {
    std::error_code error;
    const std::uintmax_t present = std::filesystem::file_size(path, error);
    if (error)
      throw InputError("The run cannot be resumed, because its table '" + path
                       + "' cannot be read: " + error.message()
                       + ". Put it back or start the run without --resume.");
    if (present < n_bytes)
      throw InputError("The run cannot be resumed, because its table '" + path
                       + "' is shorter (" + std::to_string(present)
                       + " bytes) than the checkpoint says ("
                       + std::to_string(n_bytes)
                       + "). Put it back or start the run without --resume.");
    std::string first_line;
    std::getline(std::ifstream(path), first_line);
    if (first_line + "\n" != header)
      throw InputError("The run cannot be resumed, because its table '" + path
                       + "' has other columns (" + first_line
                       + ") than this run. Start it without --resume.");
    std::filesystem::resize_file(path, n_bytes, error);
    if (error)
      throw RunError(write_failure(path, error.value()));
    buffer          = std::make_unique<FileBuffer>(path, true);
    size_at_opening = n_bytes;
    check();
  }

  void CsvTable::add_row(const std::vector<double> &values)
  {
    if (values.size() != n_columns || !buffer)
      throw std::logic_error("A row does not fit the table '" + path + "'.");
    char text[32];
    for (unsigned int i = 0; i < n_columns; ++i)
    {
      char *end = std::to_chars(text, text + 31, values[i]).ptr;
      *end++    = i + 1 < n_columns ? ',' : '\n';
      buffer->sputn(text, end - text);
    }
  }

  void CsvTable::flush()
  {
    if (buffer)
    {
      buffer->pubsync();
      check();
    }
  }

  void CsvTable::sync()
  {
    if (buffer)
    {
      buffer->sync_to_disk();
      check();
    }
  }

  std::uint64_t CsvTable::size() const
  {
    return size_at_opening + (buffer ? buffer->n_bytes() : 0);
  }

  void CsvTable::check() const
  {
    if (buffer && buffer->error() != 0)
      throw RunError(write_failure(path, buffer->error()));
  }
} // namespace quoin
