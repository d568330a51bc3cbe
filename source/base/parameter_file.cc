// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_file.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>

#include <boost/algorithm/string/join.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace quoin
{
  namespace
  {
    using dealii::ParameterHandler;

    /** A line of a parameter file, without its comment. */
    struct Line
    {
      unsigned int number = 0; /**< from 1 on */
      std::string text;
      std::string keyword; /**< its first word */
      std::string rest;    /**< the rest of the line */
    };

    std::vector<Line> lines_of(const std::string &text)
    {
      std::vector<Line> lines;
      std::istringstream stream(text);
      Line line;
      while (std::getline(stream, line.text))
      {
        ++line.number;
        line.text
            = dealii::Utilities::trim(line.text.substr(0, line.text.find('#')));
        const auto space = line.text.find_first_of(" \t");
        line.keyword     = line.text.substr(0, space);
        line.rest
            = dealii::Utilities::trim(line.text.substr(line.keyword.size()));
        lines.push_back(line);
      }
      return lines;
    }

    /** A line of the file or of one that it includes. */
    struct Origin
    {
      std::string file;
      unsigned int line;
    };

    /** A text without comments, with the files that it includes. */
    struct FullText
    {
      std::string text;
      std::vector<Origin> origins; /**< of each line */
    };

    /** The subsections around line @p number of @p text, or all of its last
        one, from the outermost. */
    std::vector<std::string> path_of_line(const std::string &text,
                                          const unsigned int number)
    {
      std::vector<std::string> path;
      for (const Line &line : lines_of(text))
      {
        if (line.number > number)
          break;
        if (line.keyword == "subsection")
          path.push_back(line.rest);
        else if (line.keyword == "end" && !path.empty())
          path.pop_back();
      }
      return path;
    }

    /** The text in one line, cut to a readable length. */
    std::string one_line(const std::string &text)
    {
      constexpr std::size_t longest = 1000;
      std::string line;
      for (const char c : text)
      {
        const bool is_space = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (line.size() == longest)
          return line + " ... ";
        if (!is_space || (!line.empty() && line.back() != ' '))
          line += is_space ? ' ' : c;
      }
      return line;
    }

    /** Names of the entries, or of the subsections, that @p prm declares in the
        section @p path; none if it does not exist. */
    std::vector<std::string> declared_names(const ParameterHandler &prm,
                                            std::vector<std::string> path,
                                            const bool of_sections)
    {
      std::stringstream stream;
      prm.print_parameters(stream, ParameterHandler::JSON);
      // Names that are no UTF-8 leave nothing to compare with.
      const nlohmann::json all = nlohmann::json::parse(stream, nullptr, false);
      if (all.is_discarded())
        return {};
      const nlohmann::json *inner = &all;
      for (const std::string &section : path)
      {
        if (!inner->contains(section))
          return {};
        inner = &inner->at(section);
      }
      std::vector<std::string> names;
      for (const auto &[name, item] : inner->items())
        if (item.is_object() && item.contains("pattern") != of_sections)
          names.push_back(name);
      return names;
    }

    /** "The nearest known one is 'a'. ", of what a line names that does not
        exist; empty if it does, or if there is nothing near. */
    std::string nearest_text(const ParameterHandler &prm, const Line &line,
                             std::vector<std::string> path)
    {
      const bool is_section = line.keyword == "subsection";
      if (is_section && !path.empty())
        path.pop_back();
      const std::string name
          = dealii::Utilities::trim(line.rest.substr(0, line.rest.find('=')));
      const auto known
          = nearest_first(name, declared_names(prm, path, is_section));
      return known.empty() || known.front() == name
                 ? ""
                 : "The nearest known one is '" + known.front() + "'. ";
    }

    /** The reason of a library's error in one line, and its place. */
    std::string describe(const dealii::ExceptionBase &error,
                         const ParameterHandler &prm, const std::string &source,
                         const FullText &full)
    {
      std::ostringstream reason;
      error.print_info(reason);
      std::string message = one_line(reason.str());
      std::smatch match;
      std::string where = source, nearest;
      if (std::regex_search(message, match,
                            std::regex("[Ll]ine <?(\\d{1,9})>?")))
      {
        const unsigned int number
            = std::min<std::size_t>(std::stoul(match[1]), full.origins.size());
        const Origin origin
            = number > 0 ? full.origins[number - 1] : Origin{ source, 0 };
        const auto path = path_of_line(full.text, number);
        where           = origin.file
                + (source.rfind("--set", 0) == 0
                       ? std::string()
                       : ", line " + std::to_string(origin.line))
                + ", section '"
                + (path.empty() ? "/" : boost::algorithm::join(path, "/"))
                + "'";
        message = std::regex_replace(
            message,
            std::regex("^ *[Ll]ine <?\\d{1,9}>? of (input )?file <[^>:]*>?: *"),
            "");
        if (number > 0)
          nearest = nearest_text(prm, lines_of(full.text)[number - 1], path);
      }
      return where + ": " + message + " " + nearest
             + "Correct it; --print-parameters shows what exists.";
    }

    std::string read_text(const std::string &file)
    {
      std::ifstream stream(file);
      std::error_code error;
      if (!stream || std::filesystem::is_directory(file, error))
        throw InputError("the parameter file '" + file
                         + "' cannot be read. Check the path.");
      std::ostringstream stored;
      stored << stream.rdbuf();
      std::string text = stored.str();
      // Some editors write a byte order mark.
      if (text.rfind("\xEF\xBB\xBF", 0) == 0)
        text.erase(0, 3);
      return text;
    }

    /** Refuses values with braces: deal.II takes them as lists of values for
        several runs and does not match them with the pattern. */
    void refuse_braces(const std::string &file, const std::string &text)
    {
      for (const Line &line : lines_of(text))
        if (line.text.find('{') != std::string::npos)
          throw InputError(file + ", line " + std::to_string(line.number)
                           + ": '" + line.text
                           + "' has a brace, which no value has. Remove "
                             "it; runs with several values need as many "
                             "commands with --set.");
    }

    /**
     * Adds @p text of @p file to @p full, with what it includes from @p folder.
     * Refuses a file that includes itself, which would never end: those in
     * @p open are being read.
     */
    void expand(const std::string &file, const std::string &text,
                const std::filesystem::path &folder,
                std::set<std::filesystem::path> &open, FullText &full)
    {
      refuse_braces(file, text);
      for (const Line &line : lines_of(text))
      {
        if (line.keyword != "include")
        {
          full.text += line.text + "\n";
          full.origins.push_back({ file, line.number });
          continue;
        }
        const std::string where = file + ", line " + std::to_string(line.number)
                                  + ": it includes '" + line.rest + "', which ";
        const std::filesystem::path path = folder / line.rest;
        std::error_code error;
        if (!std::filesystem::is_regular_file(path, error))
          throw InputError(where
                           + "is no file in the folder of the parameter file. "
                             "Check the path.");
        const auto inner = std::filesystem::canonical(path, error);
        if (!open.insert(inner).second)
          throw InputError(where
                           + "is being read already: this would never end. "
                             "Remove one of the lines 'include'.");
        const std::string included = read_text(path.string());
        if (!path_of_line(included, -1).empty())
          throw InputError(where + "leaves the subsection '"
                           + path_of_line(included, -1).back()
                           + "' open. Close it by a line 'end' there.");
        expand(path.string(), included, folder, open, full);
        open.erase(inner);
      }
    }

    /** @p text of the file or the option @p source, with what it includes. */
    FullText full_text(const std::string &file, const std::string &source,
                       const std::string &text)
    {
      std::error_code error;
      std::set<std::filesystem::path> open{ std::filesystem::canonical(file,
                                                                       error) };
      FullText full;
      expand(source, text, std::filesystem::path(file).parent_path(), open,
             full);
      return full;
    }

    /** @p source: the file or the option that contains @p text. */
    void parse_text(ParameterHandler &prm, const std::string &file,
                    const std::string &source, const std::string &text,
                    const bool skip_undefined)
    {
      const FullText full = full_text(file, source, text);
      try
      {
        std::istringstream stream(full.text);
        prm.parse_input(stream, source, "", skip_undefined);
      }
      catch (const dealii::ExceptionBase &error)
      {
        throw InputError(describe(error, prm, source, full));
      }
    }

    /** The option "Section/Name=value" as text of a parameter file. */
    std::string override_text(const std::string &option)
    {
      const auto equals = option.find('=');
      auto path
          = dealii::Utilities::split_string_list(option.substr(0, equals), '/');
      if (equals == std::string::npos || path.empty() || path.back().empty())
        throw InputError("--set '" + option
                         + "': give it as \"Section/Name=value\".");
      const std::string name = path.back();
      path.pop_back();
      std::string text;
      for (const auto &section : path)
        text += "subsection " + section + "\n";
      text += "set " + name + " = " + option.substr(equals + 1) + "\n";
      for (unsigned int i = 0; i < path.size(); ++i)
        text += "end\n";
      return text;
    }
  } // namespace

  namespace
  {
    /** Values by the names of entries, with those of their sections. */
    std::map<std::string, std::string> values_of(const std::string &text)
    {
      std::map<std::string, std::string> values;
      std::vector<std::string> path;
      for (const Line &line : lines_of(text))
        if (line.keyword == "subsection")
          path.push_back(line.rest + "/");
        else if (line.keyword == "end" && !path.empty())
          path.pop_back();
        else if (const auto equals = line.rest.find('=');
                 line.keyword == "set" && equals != std::string::npos)
          values[boost::algorithm::join(path, "")
                 + dealii::Utilities::trim(line.rest.substr(0, equals))]
              = dealii::Utilities::trim(line.rest.substr(equals + 1));
      return values;
    }
  } // namespace

  std::string parameter_changes(const std::string &before,
                                const std::string &now)
  {
    constexpr unsigned int most = 5;
    auto old                    = values_of(before);
    std::vector<std::string> changes;
    for (const auto &[name, value] : values_of(now))
    {
      const auto found = old.find(name);
      if (found == old.end())
        changes.push_back("'" + name + "' is new");
      else if (found->second != value)
        changes.push_back("'" + name + "' was '" + found->second + "' and is '"
                          + value + "'");
      old.erase(name);
    }
    for (const auto &[name, value] : old)
      changes.push_back("'" + name + "' is gone");
    const std::size_t n = changes.size();
    if (n > most)
    {
      changes.resize(most);
      changes.push_back(std::to_string(n - most) + " more");
    }
    return boost::algorithm::join(changes, ", ");
  }

  ParameterFile::ParameterFile(std::string file_,
                               std::vector<std::string> overrides_)
    : file(std::move(file_)), text(read_text(file)),
      overrides(std::move(overrides_))
  {
  }

  std::vector<std::string>
  ParameterFile::subsections(const std::string &section) const
  {
    std::string all = full_text(file, file, text).text;
    for (const std::string &option : overrides)
      all += override_text(option);
    std::vector<std::string> names;
    unsigned int depth = 0;
    bool is_inside     = false;
    for (const Line &line : lines_of(all))
      if (line.keyword == "subsection" && depth++ == 0)
        is_inside = line.rest == section;
      else if (line.keyword == "subsection" && depth == 2 && is_inside
               && !is_among(line.rest, names))
        names.push_back(line.rest);
      else if (line.keyword == "end" && depth > 0)
        --depth;
    return names;
  }

  void ParameterFile::parse(ParameterHandler &prm,
                            const bool skip_undefined) const
  {
    parse_text(prm, file, file, text, skip_undefined);
    for (const std::string &option : overrides)
      parse_text(prm, file, "--set \"" + option + "\"", override_text(option),
                 skip_undefined);
  }
} // namespace quoin
