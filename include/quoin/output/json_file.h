// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_json_file_h
#define quoin_output_json_file_h

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace quoin
{
  /**
   * Writes an object such as the summary of a run, indented; the file appears
   * complete or not at all. Numbers that are not finite become null.
   *
   * @throws RunError if the file cannot be written
   */
  void write_json(const std::string &path,
                  const nlohmann::ordered_json &object);
} // namespace quoin

#endif
