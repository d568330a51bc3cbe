// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_number_text_h
#define quoin_base_number_text_h

#include <cmath>
#include <sstream>
#include <string>

namespace quoin
{
  /** The @p parts of a message one after the other: words, integers, and
      other numbers with four digits. */
  template <typename... Parts>
  std::string text_of(const Parts &...parts)
  {
    std::ostringstream text;
    text.precision(4);
    (text << ... << parts);
    return text.str();
  }

  /** @p value for a message, with four digits. */
  inline std::string number_text(const double value)
  {
    return text_of(value);
  }

  /** "from 1 to 5", or "5" of numbers that do not differ in four digits. */
  inline std::string range_text(const double low, const double high)
  {
    // Adding 0 removes the sign of a zero.
    const std::string first = number_text(low + 0.),
                      last  = number_text(high + 0.);
    return first == last ? last : "from " + first + " to " + last;
  }

  /** "1 block", "2 blocks" */
  inline std::string count_text(const std::size_t n, const std::string &what)
  {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  }

  /** "name 5 unit", or "name unlimited". */
  inline std::string named_number(const std::string &name, const double value,
                                  const std::string &unit)
  {
    return name + " "
           + (std::isfinite(value) ? number_text(value) + " " + unit
                                   : std::string("unlimited"));
  }
} // namespace quoin

#endif
