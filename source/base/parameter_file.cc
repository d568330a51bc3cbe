// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_file.h>
#include <quoin/base/exceptions.h>

#include <boost/algorithm/string/join.hpp>

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

    /** "section 'A/B'" of line @p number of @p text. */
    std::string section_of_line(const std::string &text,
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
      return "section '"
             + (path.empty() ? "/" : boost::algorithm::join(path, "/")) + "'";
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

    /** The reason of a library's error in one line, and its place. */
    std::string describe(const dealii::ExceptionBase &error,
                         const std::string &source, const std::string &text)
    {
      std::ostringstream reason;
      error.print_info(reason);
      std::string message = one_line(reason.str());
      std::smatch match;
      std::string where = source;
      if (std::regex_search(message, match,
                            std::regex("[Ll]ine <?(\\d{1,9})>?")))
      {
        const unsigned int line = std::stoul(match[1]);
        where += (source.rfind("--set", 0) == 0
                      ? std::string()
                      : ", line " + std::to_string(line))
                 + ", " + section_of_line(text, line);
        message = std::regex_replace(
            message,
            std::regex("^ *[Ll]ine <?\\d{1,9}>? of (input )?file <[^>]*>: *"),
            "");
      }
      const bool lacks_section
          = message.find("no such subsection") != std::string::npos;
      return where + ": " + message + " Correct it"
             + (lacks_section ? ", or list its name in 'Names' of its section"
                              : "")
             + "; --print-parameters shows what exists.";
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

    /** Refuses a file that includes itself, which would never end. */
    void check_includes(const std::string &file, const std::string &text,
                        std::set<std::filesystem::path> &open)
    {
      for (const Line &line : lines_of(text))
      {
        const std::string &name = line.rest;
        if (line.keyword != "include")
          continue;
        std::error_code error;
        if (!std::filesystem::is_regular_file(name, error))
          continue;
        const auto path = std::filesystem::canonical(name, error);
        if (!open.insert(path).second)
          throw InputError(file + ": it includes '" + name
                           + "', which is being read already: this would never "
                             "end. Remove one of the lines 'include'.");
        const std::string included = read_text(name);
        refuse_braces(name, included);
        check_includes(name, included, open);
        open.erase(path);
      }
    }

    /** @p source: the file or the option that contains @p text. */
    void parse_text(ParameterHandler &prm, const std::string &file,
                    const std::string &source, const std::string &text,
                    const bool skip_undefined)
    {
      // 'include' resolves against the folder of the file.
      namespace fs = std::filesystem;
      struct Return
      {
        fs::path to;
        ~Return()
        {
          std::error_code error;
          if (!to.empty())
            fs::current_path(to, error);
        }
      } back;
      try
      {
        const auto folder = fs::path(file).parent_path();
        std::error_code error;
        std::set<fs::path> open{ fs::canonical(file, error) };
        if (!folder.empty())
        {
          back.to = fs::current_path();
          fs::current_path(folder);
        }
        refuse_braces(source, text);
        check_includes(source, text, open);
        std::istringstream stream(text);
        prm.parse_input(stream, source, "", skip_undefined);
      }
      catch (const dealii::ExceptionBase &error)
      {
        throw InputError(describe(error, source, text));
      }
      catch (const fs::filesystem_error &error)
      {
        throw InputError(file + ": its folder cannot be entered: "
                         + error.code().message() + ". Check the path.");
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

  void ParameterFile::parse(ParameterHandler &prm,
                            const bool skip_undefined) const
  {
    parse_text(prm, file, file, text, skip_undefined);
    for (const std::string &option : overrides)
      parse_text(prm, file, "--set \"" + option + "\"", override_text(option),
                 skip_undefined);
  }
} // namespace quoin
