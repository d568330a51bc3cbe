// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_noted_parameters_h
#define quoin_base_noted_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <set>
#include <string>

namespace quoin
{
  /** Parameters with notes of the entries that a ParameterSection has read and
      of the places where they are set. */
  class NotedParameters : public dealii::ParameterHandler
  {
  public:
    /** Names of the entries read, with their sections as in "Section/Name". */
    std::set<std::string> read;

    /** Where entries are set, by the same names: "FILE, line N" or "FILE with
        --set ..."; those that keep their defaults are not there. */
    std::map<std::string, std::string> places;
  };

  /** Where the entry "Section/Name" of @p prm is set, if that has notes of it;
      otherwise @p file. */
  inline std::string place_of(const dealii::ParameterHandler &prm,
                              const std::string &entry, const std::string &file)
  {
    const auto *const noted = dynamic_cast<const NotedParameters *>(&prm);
    if (!noted)
      return file;
    const auto place = noted->places.find(entry);
    return place == noted->places.end() ? file : place->second;
  }
} // namespace quoin

#endif
