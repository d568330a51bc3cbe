// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_noted_parameters_h
#define quoin_base_noted_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace quoin
{
  /** Where entries are set, by their names with sections as in
      "Section/Name": "FILE, line N" or "FILE with --set ..."; those that keep
      their defaults are not there. */
  using ParameterPlaces = std::map<std::string, std::string>;

  /** Parameters with notes of the entries that a ParameterSection has read and
      of the places where they are set. */
  class NotedParameters : public dealii::ParameterHandler
  {
  public:
    /** Names of the entries read, with their sections as in "Section/Name". */
    std::set<std::string> read;

    ParameterPlaces places;

    /** Warnings of entries that one file sets twice. */
    std::vector<std::string> repeated;

    /** Whether a message about a wrong value of the entry with the first name
        is to suggest the second word; null: it may suggest all words. */
    std::function<bool(const std::string &, const std::string &)> suggests;
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

  /** The section of an entry in a message, as ", section 'Loads/weight'", or
     that it is in none. @p path: names of sections, "" for the top level. */
  inline std::string section_phrase(const std::string &path)
  {
    return path.empty() ? ", outside of all sections"
                        : ", section '" + path + "'";
  }

  /**
   * The error @p message "FILE, section 'SECTION': 'NAME = ..." with the place
   * where that entry is set for @p file. If the entry keeps its default or the
   * message names none, it is the file that has all entries of that section. A
   * message of another form, or about a section whose entries several files
   * set, is returned as it is.
   */
  std::string with_place(const std::string &message, const std::string &file,
                         const ParameterPlaces &places);
} // namespace quoin

#endif
