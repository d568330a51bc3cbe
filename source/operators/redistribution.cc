// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/redistribution.h>

namespace quoin
{
  Redistribution::Places::Places(const EntryNumbers::List &numbers)
    : found(numbers.size(), false)
  {
    for (unsigned int i = 0; i < numbers.size(); ++i)
      here.emplace_back(numbers[i], i);
    std::sort(here.begin(), here.end());
  }

  void Redistribution::Places::look_up(const EntryNumbers::List &there,
                                       const std::size_t n_taken,
                                       const std::size_t n)
  {
    n_there = n;
    moves.clear();
    for (unsigned int i = 0; i < n_taken; ++i)
      for (auto place = std::lower_bound(here.begin(), here.end(),
                                         std::make_pair(there[i], 0U));
           place != here.end() && place->first == there[i]; ++place)
      {
        moves.push_back({ i, place->second });
        found[place->second] = true;
      }
  }

  bool Redistribution::Places::has(const std::uint64_t number) const
  {
    const auto place = std::lower_bound(here.begin(), here.end(),
                                        std::make_pair(number, 0U));
    return place != here.end() && place->first == number;
  }

  Redistribution::Redistribution(EntryNumbers numbers, const bool is_first_rank)
    : is_first_rank(is_first_rank), nodes(numbers.nodes), cells(numbers.cells)
  {
    numbers.nodes.resize(numbers.n_owned_nodes);
    owned_nodes = Places(numbers.nodes);
    for (const auto &[name, list] : numbers.own)
      own.emplace(name, list);
  }

  void Redistribution::begin_part(const EntryNumbers &there)
  {
    is_first_part = !has_parts;
    has_parts     = true;
    // Entries of ghosts may be older than their owners'.
    nodes.look_up(there.nodes, there.n_owned_nodes, there.nodes.size());
    owned_nodes.look_up(there.nodes, there.n_owned_nodes, there.n_owned_nodes);
    cells.look_up(there.cells, there.cells.size(), there.cells.size());
    for (auto &[name, places] : own)
    {
      const auto list = there.own.find(name);
      if (list == there.own.end())
        throw std::runtime_error("it says nothing of '" + name + "'");
      places.look_up(list->second, list->second.size(), list->second.size());
    }
  }

  void Redistribution::check_complete() const
  {
    const auto check = [](const std::string &name, const Places &places)
    {
      if (std::find(places.found.begin(), places.found.end(), false)
          != places.found.end())
        throw std::runtime_error("those of all ranks lack some of '" + name
                                 + "'");
    };
    check("nodes", nodes);
    for (const auto &[name, places] : own)
      check(name, places);
  }
} // namespace quoin
