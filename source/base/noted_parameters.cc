// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/noted_parameters.h>

namespace quoin
{
  std::string with_place(const std::string &message, const std::string &file,
                         const ParameterPlaces &places)
  {
    const std::string before = file + ", section '";
    if (message.compare(0, before.size(), before) != 0)
      return message;
    const auto section_end = message.find('\'', before.size());
    if (section_end == std::string::npos)
      return message;
    const std::string section
        = message.substr(before.size(), section_end - before.size()) + "/";
    const auto with = [&](const std::string &place)
    { return place + message.substr(file.size()); };

    const std::string between = "': '";
    if (message.compare(section_end, between.size(), between) == 0)
    {
      const auto begin = section_end + between.size();
      auto name
          = message.substr(begin, message.find_first_of("='", begin) - begin);
      name.erase(name.find_last_not_of(' ') + 1);
      if (const auto place = places.find(section + name); place != places.end())
        return with(place->second);
    }

    std::string only;
    for (auto place = places.lower_bound(section);
         place != places.end()
         && place->first.compare(0, section.size(), section) == 0;
         ++place)
    {
      // A place is a file with its line or with an option.
      const auto line = place->second.rfind(", line ");
      if (line == std::string::npos)
        continue;
      const std::string here = place->second.substr(0, line);
      if (!only.empty() && here != only)
        return message;
      only = here;
    }
    return only.empty() ? message : with(only);
  }
} // namespace quoin
