// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_expression_h
#define quoin_base_expression_h

#include <functional>
#include <string>

namespace quoin
{
  /**
   * Call @p parse, which hands the one expression @p text to a parser of
   * deal.II and evaluates it. Throws an InputError that begins with @p what
   * if the parser fails, without what it prints by itself, and if @p text has
   * a comma outside of brackets or a semicolon: the parser would take what
   * stands behind it for the expression, as with 0,5 for 0.5.
   */
  void parse_expression(const std::string &text, const std::string &what,
                        const std::function<void()> &parse);
} // namespace quoin

#endif
