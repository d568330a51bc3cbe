// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/nearest_name.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace quoin
{
  std::size_t edit_distance(const std::string &a, const std::string &b)
  {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      std::size_t diagonal = row[0]++;
      for (std::size_t j = 0; j < b.size(); ++j)
        diagonal = std::exchange(
            row[j + 1], std::min({ row[j] + 1, row[j + 1] + 1,
                                   diagonal + (a[i] == b[j] ? 0 : 1) }));
    }
    return row.back();
  }

  namespace
  {
    /** Whether @p name goes on from @p wanted, a word at least. */
    bool begins_with(const std::string &name, const std::string &wanted)
    {
      return wanted.size() >= 4 && name.rfind(wanted, 0) == 0;
    }
  } // namespace

  std::string nearest_name(const std::string &wanted,
                           const std::vector<std::string> &names)
  {
    const auto sorted = nearest_first(wanted, names);
    // Two letters may have changed places.
    const std::size_t most
        = wanted.size() < 4 ? 1 : std::max<std::size_t>(2, wanted.size() / 3);
    return sorted.empty()
                   || (!begins_with(sorted.front(), wanted)
                       && edit_distance(wanted, sorted.front()) > most)
               ? ""
               : sorted.front();
  }

  std::vector<std::string> near_names(const std::string &wanted,
                                      const std::vector<std::string> &names)
  {
    constexpr std::size_t most = 6;
    const auto words = dealii::Utilities::split_string_list(wanted, ' ');
    auto sorted      = nearest_first(wanted, names);
    std::stable_partition(sorted.begin(), sorted.end(),
                          [&](const std::string &name)
                          {
                            const std::string text = ' ' + name + ' ';
                            return std::all_of(words.begin(), words.end(),
                                               [&](const std::string &word) {
                                                 return text.find(' ' + word
                                                                  + ' ')
                                                        != std::string::npos;
                                               });
                          });
    sorted.resize(std::min(most, sorted.size()));
    return sorted;
  }

  std::vector<std::string> nearest_first(const std::string &wanted,
                                         std::vector<std::string> names)
  {
    const auto distance = [&](const std::string &name) {
      return std::pair(!begins_with(name, wanted), edit_distance(wanted, name));
    };
    std::stable_sort(names.begin(), names.end(),
                     [&](const std::string &a, const std::string &b)
                     { return distance(a) < distance(b); });
    return names;
  }
} // namespace quoin
