// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_number_text_h
#define quoin_base_number_text_h

#include <cmath>
#include <sstream>
#include <string>

namespace quoin
{
  /** @p value for a message, with four digits. */
  inline std::string number_text(const double value)
  {
    std::ostringstream text;
    text.precision(4);
    text << value;
    return text.str();
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
