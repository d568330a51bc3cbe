// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_table.h>
#include <quoin/base/number_text.h>
#include <quoin/signals/time_table.h>

#include <algorithm>

namespace quoin
{
  TimeTable read_time_table(const std::string &name)
  {
    TimeTable table;
    for (const TableRow &row : read_number_table(name, 2, "a time and a value"))
    {
      if (!table.empty() && row.values[0] == table.back().first)
        throw InputError("the table '" + name + "' has the time "
                         + number_text(row.values[0]) + " of line "
                         + std::to_string(row.line)
                         + " twice. Times must grow: let a jump take a little "
                           "time.");
      if (!table.empty() && row.values[0] < table.back().first)
        throw InputError("the table '" + name + "' goes back in time in line "
                         + std::to_string(row.line) + ".");
      table.emplace_back(row.values[0], row.values[1]);
    }
    return table;
  }

  double interpolate(const TimeTable &table, const double time)
  {
    const auto after = std::upper_bound(table.begin(), table.end(),
                                        std::make_pair(time, 1e300));
    if (after == table.begin())
      return table.front().second;
    if (after == table.end())
      return table.back().second;
    const auto &[t0, v0] = *(after - 1);
    const auto &[t1, v1] = *after;
    return v0 + (v1 - v0) * (time - t0) / (t1 - t0);
  }
} // namespace quoin
