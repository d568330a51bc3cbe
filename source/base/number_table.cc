// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/finite_numbers.h>
#include <quoin/base/number_table.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Whether @p word looks like a number, such as "2", "-.5" or "5m". */
    bool begins_as_number(const std::string &word)
    {
      const std::size_t first = word.find_first_not_of("+-.");
      return first != std::string::npos
             && std::isdigit(static_cast<unsigned char>(word[first]));
    }
  } // namespace

  std::vector<TableRow> read_number_table(const std::string &file,
                                          const unsigned int n_columns,
                                          const std::string &row)
  {
    std::ifstream stream(file);
    if (!stream)
      throw InputError("the table '" + file
                       + "' cannot be read. Check its path.");
    std::vector<TableRow> rows;
    std::string line;
    for (unsigned int number = 1; std::getline(stream, line); ++number)
    {
      // Some editors write a byte order mark.
      if (number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0)
        line.erase(0, 3);
      line = line.substr(0, line.find('#'));
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream stream_of_words(line);
      std::vector<std::string> words;
      for (std::string word; stream_of_words >> word;)
        words.push_back(word);
      if (words.empty()
          || (rows.empty()
              && std::none_of(words.begin(), words.end(), begins_as_number)))
        continue;
      const auto values = finite_numbers(words);
      if (values.size() != n_columns)
        throw InputError("line " + std::to_string(number) + " of the table '"
                         + file + "' is not " + row
                         + ". Correct it, or put a # before it if it is a "
                           "heading.");
      rows.push_back({ number, values });
    }
    if (rows.empty())
      throw InputError("the table '" + file + "' has no rows. Each should be "
                       + row + ".");
    return rows;
  }
} // namespace quoin
