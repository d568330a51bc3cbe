// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/expression.h>

#include <deal.II/base/exceptions.h>

#include <iostream>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Keeps what is printed as an error from the screen while it lives. */
    class QuietErrors
    {
    public:
      QuietErrors() : screen(std::cerr.rdbuf(unseen.rdbuf()))
      {
      }
      ~QuietErrors()
      {
        std::cerr.rdbuf(screen);
      }
      QuietErrors(const QuietErrors &) = delete;

    private:
      std::ostringstream unseen;
      std::streambuf *screen;
    };

    void check_separators(const std::string &text, const std::string &what)
    {
      int depth = 0;
      for (std::size_t i = 0; i < text.size(); ++i)
      {
        depth += (text[i] == '(') - (text[i] == ')');
        if (text[i] == ';' || (text[i] == ',' && depth <= 0))
          throw InputError(what + ": '" + text + "' has a "
                           + (text[i] == ';'
                                  ? "semicolon. Give one expression."
                                  : "comma outside of brackets. Write "
                                    "numbers with decimal points, 0.5 for "
                                    "0,5, and one expression."));
      }
    }
  } // namespace

  void parse_expression(const std::string &text, const std::string &what,
                        const std::function<void()> &parse)
  {
    check_separators(text, what);
    try
    {
      const QuietErrors quiet;
      parse();
    }
    catch (const dealii::ExceptionBase &error)
    {
      std::ostringstream reason;
      error.print_info(reason);
      throw InputError(what + ": " + reason.str());
    }
  }
} // namespace quoin
