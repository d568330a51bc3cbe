// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/atomic_file.h>
#include <quoin/output/json_file.h>

#include <nlohmann/json.hpp>

namespace quoin
{
  void write_json(const std::string &path, const nlohmann::ordered_json &object)
  {
    // File names need not be valid UTF-8; invalid bytes are replaced.
    write_text(path, object.dump(2, ' ', false,
                                 nlohmann::json::error_handler_t::replace)
                         + "\n");
  }
} // namespace quoin
