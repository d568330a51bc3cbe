// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/loads/time_table.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace quoin
{
  TimeTable read_time_table(const std::string &name)
  {
    std::ifstream file(name);
    if (!file)
      throw InputError("the table '" + name + "' cannot be read.");
    TimeTable table;
    std::string line;
    unsigned int number = 0;
    while (std::getline(file, line))
    {
      ++number;
      std::replace(line.begin(), line.end(), ',', ' ');
      line = line.substr(0, line.find('#'));
      std::istringstream words(line);
      double time, value;
      std::string rest;
      if (words >> time >> value && !(words >> rest))
      {
        if (!table.empty() && time <= table.back().first)
          throw InputError("the table '" + name
                           + "' goes back in time "
                             "in line "
                           + std::to_string(number) + ".");
        table.emplace_back(time, value);
      }
      else if (!table.empty()
               && line.find_first_not_of(" \t\r") != std::string::npos)
        throw InputError("line " + std::to_string(number) + " of the table '"
                         + name + "' is not a time and a value.");
    }
    if (table.empty())
      throw InputError("the table '" + name + "' has no rows.");
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
