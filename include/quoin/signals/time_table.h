// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_time_table_h
#define quoin_signals_time_table_h

#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /** Times [s], ascending, and values. */
  using TimeTable = std::vector<std::pair<double, double>>;

  /**
   * Reads a file with rows "time, value" or "time value", see
   * read_number_table(). Throws InputError.
   */
  TimeTable read_time_table(const std::string &file);

  /** Value at @p time, linear in between and constant beyond the ends. */
  double interpolate(const TimeTable &table, double time);
} // namespace quoin

#endif
