// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/finite_numbers.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  std::vector<double> finite_numbers(const std::vector<std::string> &words)
  {
    std::vector<double> values;
    try
    {
      values = dealii::Utilities::string_to_double(words);
    }
    catch (const dealii::ExceptionBase &)
    {
    }
    if (!std::all_of(values.begin(), values.end(),
                     [](const double value) { return std::isfinite(value); }))
      values.clear();
    return values;
  }
} // namespace quoin
