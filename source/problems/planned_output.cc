// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/planned_output.h>
#include <quoin/results/measurements.h>

#include <algorithm>

namespace quoin
{
  PlannedOutput planned_output(const Parameters &parameters,
                               const std::vector<double> &time_steps)
  {
    PlannedOutput result;
    const auto count
        = [](const double n) { return std::uint64_t(std::min(n, 1e18)); };
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      // Each stage has an output at its end.
      ++result.fields;
      if (i < time_steps.size())
        ++result.rows;
      if (stage.end != StageEnd::time || stage.slows_loads())
        result.is_least = true;
      if (stage.end != StageEnd::time)
        continue;
      if (parameters.field_interval > 0.)
        result.fields
            += count(stage.duration / parameters.field_interval * (1. + 1e-9));
      if (i < time_steps.size())
        result.rows
            += count(stage.duration
                     / std::max(parameters.history_interval, time_steps[i]));
    }
    return result;
  }

  void report_memory_and_disk(const RunContext &run, const std::string &more,
                              const PlannedOutput &planned,
                              const double bytes_of_fields,
                              const std::size_t n_columns)
  {
    constexpr double bytes_of_number = 18.;
    run.log.message("memory: ", bytes_text(resident_memory(run.communicator)),
                    " by now", more);
    const char *least = planned.is_least ? " or more" : "";
    std::string rows;
    if (planned.rows > 0)
      rows = text_of("; ", planned.rows, " rows of tables", least, ", ",
                     bytes_text(double(planned.rows) * double(n_columns)
                                * bytes_of_number));
    run.log.message("disk: ", planned.fields, " output times of fields", least,
                    ", ", bytes_text(double(planned.fields) * bytes_of_fields),
                    rows);
  }
} // namespace quoin
