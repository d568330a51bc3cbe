// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_file.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/noted_parameters.h>
#include <quoin/base/parameter_section.h>

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
      unsigned int number = 0; /**< line number, from 1 on */
      std::string text;
      std::string keyword; /**< first word of the line */
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
      std::vector<Origin> origins; /**< origin of each line */
    };

    /** The lines that begin the subsections around line @p number of @p text,
        or those that are open at its end, from the outermost. */
    std::vector<Line> subsections_around(const std::string &text,
                                         const unsigned int number)
    {
      std::vector<Line> open;
      for (const Line &line : lines_of(text))
      {
        if (line.number > number)
          break;
        if (line.keyword == "subsection")
          open.push_back(line);
        else if (line.keyword == "end" && !open.empty())
          open.pop_back();
      }
      return open;
    }

    std::vector<std::string> names_of(const std::vector<Line> &subsections)
    {
      std::vector<std::string> names;
      for (const Line &line : subsections)
        names.push_back(line.rest);
      return names;
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

    /** What the entry @p name of the section @p path takes, as the library
        describes it; empty if there is no such entry. */
    std::string pattern_of(const ParameterHandler &prm,
                           std::vector<std::string> path,
                           const std::string &name)
    {
      std::stringstream stream;
      prm.print_parameters(stream, ParameterHandler::JSON);
      const nlohmann::json all = nlohmann::json::parse(stream, nullptr, false);
      path.push_back(name);
      const nlohmann::json *inner = &all;
      for (const std::string &part : path)
      {
        if (!inner->contains(part))
          return "";
        inner = &inner->at(part);
      }
      return inner->value("pattern_description", "");
    }

    /** Values of an entry above which a complaint lists the near ones alone. */
    constexpr unsigned int most_listed = 20;

    /** What is wrong with a line, and advice. */
    struct Complaint
    {
      std::string what, advice;
    };

    Complaint complaint(std::string what, const std::string &nearest)
    {
      return { std::move(what), nearest.empty() ? ""
                                                : "The nearest known one is '"
                                                      + nearest + "'. " };
    }

    /** What a number must be whose entry has no words of its own, from the
        library's description @p pattern; empty if that is of no number. */
    std::string number_words(const std::string &pattern)
    {
      std::smatch match;
      if (!std::regex_search(pattern, match,
                             std::regex("^\\[(Double|Integer)(?: range)? "
                                        "(?:(\\S+)\\.\\.\\.(\\S+) )?")))
        return "";
      const std::string kind
          = match[1] == "Double" ? "a number" : "a whole number";
      // The library writes bounds that are none as its largest numbers.
      const auto is_bound = [](const std::string &bound)
      {
        return !bound.empty() && bound.find("MAX") == std::string::npos
               && bound.find("21474836") == std::string::npos;
      };
      const std::string least = match[2], most = match[3];
      if (is_bound(least) && is_bound(most))
        return kind + " from " + least + " to " + most;
      return kind + (is_bound(least) ? " of at least " + least : "")
             + (is_bound(most) ? " of at most " + most : "");
    }

    /** Advice on the wrong @p value of a number, if it has a decimal comma. */
    std::string comma_advice(const std::string &value)
    {
      static const std::regex decimal("[-+]?[0-9]*,[0-9]+([eE][-+]?[0-9]+)?");
      if (!std::regex_match(value, decimal))
        return "";
      std::string with_point           = value;
      with_point[with_point.find(',')] = '.';
      return "Decimals have a point: write " + with_point + ". ";
    }

    /** A complaint in our own words about @p line of the section @p path; none
        if it has another fault than an unknown name or a wrong value. */
    Complaint complaint_about(const ParameterHandler &prm, const Line &line,
                              std::vector<std::string> path)
    {
      const bool is_section = line.keyword == "subsection";
      if (is_section && !path.empty())
        path.pop_back();
      const auto equals = line.rest.find('=');
      const std::string name
          = dealii::Utilities::trim(line.rest.substr(0, equals));
      const auto known
          = nearest_first(name, declared_names(prm, path, is_section));
      if (!is_section && line.keyword != "set")
        return {};
      if (!is_section && equals == std::string::npos)
        return { "the '=' is missing in 'set " + line.rest + "'.",
                 "Write 'set NAME = VALUE'. " };
      if (!is_among(name, known))
        return complaint(std::string("there is no ")
                             + (is_section ? "subsection" : "parameter") + " '"
                             + name + "' here.",
                         known.empty() ? "" : known.front());
      const std::string value
          = dealii::Utilities::trim(line.rest.substr(equals + 1));
      const std::string pattern      = pattern_of(prm, path, name);
      const std::string given        = "'" + name + " = " + value + "' ";
      static const std::string begin = "[Selection ";
      if (!is_section && pattern.rfind(begin, 0) == 0)
      {
        const auto words = dealii::Utilities::split_string_list(
            pattern.substr(begin.size(), pattern.find(']') - begin.size()),
            '|');
        if (words.size() <= most_listed)
          return complaint(given + "must be one of: " + known_names(words)
                               + ".",
                           nearest_name(value, words));
        auto suggested    = words;
        const auto *noted = dynamic_cast<const NotedParameters *>(&prm);
        if (noted && noted->suggests)
          suggested.erase(std::remove_if(suggested.begin(), suggested.end(),
                                         [&](const std::string &word) {
                                           return !noted->suggests(name, word);
                                         }),
                          suggested.end());
        return { given + "is none of the " + std::to_string(words.size())
                     + " known values, which 'quoin --print-schema' lists.",
                 "Near ones are: " + known_names(near_names(value, suggested))
                     + ". " };
      }
      if (const std::string words = number_words(pattern);
          !is_section && !words.empty())
        return { given + "must be " + words + ", without formula or unit.",
                 pattern.find("Integer") == std::string::npos
                     ? comma_advice(value)
                     : "" };
      return is_section || pattern.empty() || pattern.front() == '['
                 ? Complaint()
                 : Complaint{ given + "must be a " + pattern + ".",
                              comma_advice(value) };
    }

    /** That an 'end' is missing before @p line of @p full, or at its end, if
        that is likely. */
    std::string open_text(const ParameterHandler &prm, const Line &line,
                          const FullText &full)
    {
      const bool is_at_end = line.number >= full.origins.size();
      const auto open      = subsections_around(full.text, line.number);
      const bool is_of_top
          = line.keyword == "subsection" && open.size() > 1
            && is_among(line.rest, declared_names(prm, {}, true));
      if (open.empty() || !(is_at_end || is_of_top))
        return "";
      const Line &begin   = open.front();
      const Origin &place = full.origins[begin.number - 1];
      return "a line 'end' is missing: the subsection '" + begin.rest
             + "', which begins in line " + std::to_string(place.line) + " of "
             + place.file + ", or one within it, is still open "
             + (is_at_end ? "at the end of the file." : "here.");
    }

    /** The reason of a library's error in one line, and its place. */
    std::string describe(const dealii::ExceptionBase &error,
                         const ParameterHandler &prm, const std::string &source,
                         const FullText &full)
    {
      const bool is_option = source.rfind("--set", 0) == 0;
      std::ostringstream reason;
      error.print_info(reason);
      const std::string message = one_line(reason.str());
      const auto lines          = lines_of(full.text);
      std::string where         = source;
      Complaint found;
      unsigned int number = lines.size();
      if (std::smatch match; std::regex_search(
              message, match, std::regex("[Ll]ine <?(\\d{1,9})>?")))
      {
        number = std::min<std::size_t>(std::stoul(match[1]), lines.size());
        const Origin origin
            = number > 0 ? full.origins[number - 1] : Origin{ source, 0 };
        const auto path = names_of(subsections_around(full.text, number));
        where           = origin.file
                + (is_option ? std::string()
                             : ", line " + std::to_string(origin.line))
                + section_phrase(boost::algorithm::join(path, "/"));
        if (number > 0)
          found = complaint_about(prm, lines[number - 1], path);
      }
      if (number > 0 && !is_option)
        if (const std::string open = open_text(prm, lines[number - 1], full);
            !open.empty())
          found = { open, "" };
      if (found.what.empty())
        found.what = std::regex_replace(
            message,
            std::regex("^ *[Ll]ine <?\\d{1,9}>? of (input )?file <[^>:]*>?: *"),
            "");
      return where + ": " + found.what + " " + found.advice
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
        if (const auto left = subsections_around(included, -1); !left.empty())
          throw InputError(where + "leaves the subsection '" + left.back().rest
                           + "' of line " + std::to_string(left.back().number)
                           + " open. Close it by a line 'end' there.");
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

    /** Notes where the entries of @p full, of @p file or of an option beside
        it, are set, and which ones a file sets twice. */
    void note_places(ParameterHandler &prm, const std::string &file,
                     const FullText &full, const bool is_option)
    {
      auto *const noted = dynamic_cast<NotedParameters *>(&prm);
      if (!noted)
        return;
      std::vector<std::string> path;
      std::map<std::string, Origin> last;
      for (const Line &line : lines_of(full.text))
        if (line.keyword == "subsection")
          path.push_back(line.rest);
        else if (line.keyword == "end" && !path.empty())
          path.pop_back();
        else if (line.keyword == "set")
        {
          const std::string section = boost::algorithm::join(path, "/");
          const std::string name    = dealii::Utilities::trim(
                 line.rest.substr(0, line.rest.find('=')));
          const std::string entry
              = section.empty() ? name : section + "/" + name;
          const Origin &origin = full.origins[line.number - 1];
          const std::string place
              = is_option
                    ? file + " with " + origin.file
                    : origin.file + ", line " + std::to_string(origin.line);
          noted->places[entry] = place;
          // A file may set anew what one that it includes has set.
          const auto [before, is_new] = last.insert({ entry, origin });
          if (!is_new && before->second.file == origin.file)
            noted->repeated.push_back(
                place + section_phrase(section) + ": '" + name
                + "' was set in line " + std::to_string(before->second.line)
                + " already, and the last value counts. Remove one of them.");
          before->second = origin;
        }
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
      note_places(prm, file, full, source != file);
    }

    /** Sections and name of the entry that the option "Section/Name=value"
        sets. */
    std::vector<std::string> path_of_option(const std::string &option)
    {
      const auto equals = option.find('=');
      const auto path
          = dealii::Utilities::split_string_list(option.substr(0, equals), '/');
      if (equals == std::string::npos || path.empty() || path.back().empty())
        throw InputError("--set '" + option
                         + "': give it as \"Section/Name=value\".");
      return path;
    }

    /** That option as text of a parameter file. */
    std::string override_text(const std::string &option)
    {
      auto path              = path_of_option(option);
      const std::string name = path.back();
      path.pop_back();
      std::string text;
      for (const auto &section : path)
        text += "subsection " + section + "\n";
      text
          += "set " + name + " = " + option.substr(option.find('=') + 1) + "\n";
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

  std::vector<std::string>
  ParameterFile::idle_overrides(NotedParameters &prm) const
  {
    std::vector<std::string> warnings;
    for (const std::string &option : overrides)
    {
      const auto path = path_of_option(option);
      if (prm.read.count(boost::algorithm::join(path, "/")) > 0)
        continue;
      const std::string begin = "--set \"" + option + "\": ";
      if (path.size() == 3)
        if (const auto listed
            = ParameterSection(ParameterSection(prm, file), path[0])
                  .list("Names");
            !is_among(path[1], listed))
          throw InputError(
              begin + "it has no effect, because 'Names' of section '" + path[0]
              + "' does not list '" + path[1]
              + "'. Listed are: " + known_names_like(path[1], listed) + ".");
      warnings.push_back(begin
                         + "it has no effect, because the other parameters "
                           "of "
                         + file + " leave '" + path.back()
                         + "' unused. Leave this option out, or change what "
                           "the parameter goes with: --print-parameters says "
                           "when it is used.");
    }
    return warnings;
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
