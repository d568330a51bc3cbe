// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_numbered_names_h
#define quoin_layout_numbered_names_h

#include <quoin/base/parameter_section.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /** The numbers of "3" or "1-3" as first and last; {0, 0} of other text. */
  inline std::array<unsigned int, 2> number_range(const std::string &text)
  {
    const auto minus        = text.find('-');
    const std::string first = text.substr(0, minus);
    const std::string last
        = minus == std::string::npos ? first : text.substr(minus + 1);
    for (const std::string &word : { first, last })
      if (word.empty() || word.size() > 9
          || word.find_first_not_of("0123456789") != std::string::npos)
        return { { 0, 0 } };
    return { { static_cast<unsigned int>(std::stoul(first)),
               static_cast<unsigned int>(std::stoul(last)) } };
  }

  /**
   * The names that @p pairs, the value of the entry @p name, give to numbers
   * from 1 to @p most, such as plinth:1-2, band:9. Throws an InputError which
   * ends in @p must_be about other numbers, or one with two names.
   */
  inline std::map<unsigned int, std::string>
  numbered_names(const ParameterSection &section, const std::string &name,
                 const std::vector<std::pair<std::string, std::string>> &pairs,
                 const unsigned int most, const std::string &must_be)
  {
    std::map<unsigned int, std::string> result;
    for (const auto &[word, numbers] : pairs)
    {
      const auto [first, last] = number_range(numbers);
      if (first < 1 || last < first || last > most)
        section.fail(name, must_be);
      for (unsigned int number = first; number <= last; ++number)
        if (!result.emplace(number, word).second)
          section.fail(name, must_be);
    }
    return result;
  }
} // namespace quoin

#endif
