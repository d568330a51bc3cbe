// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/parameters/schema.h>

#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

namespace quoin
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /** Adds type and range from the description of a pattern: those of
        ParameterEntries and of the library. */
    void add_type(const std::string &pattern, Json &entry)
    {
      std::smatch match;
      const auto matches = [&](const char *text)
      { return std::regex_search(pattern, match, std::regex(text)); };
      const auto number = [&](const int i) { return std::stod(match[i]); };
      entry["type"]     = "text";
      if (matches("^number"))
      {
        entry["type"] = "number";
        if (matches("from (\\S+) to (\\S+)"))
        {
          entry["minimum"] = number(1);
          entry["maximum"] = number(2);
        }
        else if (matches("above (\\S+)"))
          entry["above"] = number(1);
        else if (matches("of at least (\\S+)"))
          entry["minimum"] = number(1);
      }
      else if (matches("^list"))
        entry["type"] = "list";
      else if (matches("\\[Integer range (-?\\d+)\\.\\.\\.(-?\\d+)"))
      {
        entry["type"]    = "integer";
        entry["minimum"] = number(1);
        if (number(2) < dealii::Patterns::Integer::max_int_value)
          entry["maximum"] = number(2);
      }
      else if (matches("\\[Selection (.*[^ ]) *\\]"))
      {
        const auto words
            = dealii::Utilities::split_string_list(match[1].str(), '|');
        entry["type"]    = words.front() == "yes" ? "flag" : "choice";
        entry["choices"] = words;
      }
    }

    Json entry_of(const std::string &name, const Json &given)
    {
      Json entry                    = { { "name", name } };
      const std::string description = given.at("documentation");
      add_type(given.at("pattern_description"), entry);
      std::smatch unit;
      if (std::regex_search(description, unit,
                            std::regex("\\[([^\\[\\]]+)\\]\\.?$")))
        entry["unit"] = unit[1].str();
      entry["default"]     = given.at("default_value");
      entry["description"] = description;
      return entry;
    }

    bool is_entry(const Json &item)
    {
      return item.contains("pattern_description");
    }

    Json entries_of(const Json &section)
    {
      Json entries = Json::array();
      for (const auto &[name, item] : section.items())
        if (is_entry(item))
          entries.push_back(entry_of(name, item));
      return entries;
    }
  } // namespace

  std::string schema_text(const dealii::ParameterHandler &prm)
  {
    using Handler = dealii::ParameterHandler;
    std::stringstream stream;
    prm.print_parameters(stream, Handler::JSON | Handler::KeepDeclarationOrder);
    const Json all = Json::parse(stream);
    Json schema    = { { "program", "quoin" },
                       { "version", QUOIN_VERSION },
                       { "entries", entries_of(all) },
                       { "sections", Json::array() } };
    for (const auto &[name, item] : all.items())
    {
      if (is_entry(item))
        continue;
      Json section = { { "name", name }, { "entries", entries_of(item) } };
      for (const auto &[inner, each] : item.items())
        if (!is_entry(each))
          section["each"] = entries_of(each);
      schema["sections"].push_back(section);
    }
    return schema.dump(1) + "\n";
  }
} // namespace quoin
