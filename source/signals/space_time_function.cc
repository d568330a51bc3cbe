// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/signals/space_time_function.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/expression.h>
#include <quoin/signals/time_function.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/utilities.h>

#include <memory>
#include <regex>

namespace quoin
{
  namespace
  {
    bool mentions(const std::string &expression, const std::string &variables)
    {
      return std::regex_search(expression,
                               std::regex("\\b[" + variables + "]\\b"));
    }

    /** The expression in @p text, which may come after a table or a signal. */
    std::string expression_in(const std::string &text)
    {
      const std::size_t times = text.find(" times ");
      return !TimeFunction::is_named(text) ? text
             : times == std::string::npos  ? "1"
                                           : text.substr(times + 7);
    }
  } // namespace

  bool SpaceTimeFunction::names_place(const std::string &text)
  {
    return mentions(expression_in(dealii::Utilities::trim(text)), "xyz");
  }

  SpaceTimeFunction::SpaceTimeFunction(const std::string &given,
                                       const std::string &folder,
                                       const unsigned int dim,
                                       const bool of_stage)
  {
    const std::string names = of_stage   ? "x, y, z, t and T"
                              : dim == 2 ? "x, y and t"
                                         : "x, y, z and t";
    std::string text        = dealii::Utilities::trim(given);
    if (text.empty())
      throw InputError("lacks an expression of " + names + ".");
    TimeFunction named; // a table or a signal
    const bool is_named = TimeFunction::is_named(text);
    if (is_named)
    {
      named   = TimeFunction(text.substr(0, text.find(" times ")), folder);
      text    = expression_in(text);
      on_time = true;
    }
    // The parser takes four variables.
    const bool has_total = of_stage && mentions(text, "T");
    if (has_total && mentions(text, "z"))
      throw InputError("is an expression of both z and T, of which it can have "
                       "one: take t, the time in the stage.");

    const auto parser = std::make_shared<dealii::FunctionParser<3>>(1);
    // Without z the third component has a name that no expression has.
    parse_expression(text, "is no expression of " + names,
                     [&]()
                     {
                       parser->initialize(has_total  ? "x,y,T,t"
                                          : dim == 2 ? "x,y,z_,t"
                                                     : "x,y,z,t",
                                          text, { { "pi", constants::pi } },
                                          true);
                       parser->value(dealii::Point<3>());
                     });
    on_place = mentions(text, "xyz");
    on_z     = mentions(text, "z");
    on_time  = on_time || mentions(text, "tT");
    evaluate = [parser, has_total](dealii::Point<3> x, const TimePoint &time)
    {
      if (has_total)
        x[2] = time.total;
      parser->set_time(time.stage);
      return parser->value(x);
    };
    if (is_named)
      evaluate = [named, factor = evaluate](const dealii::Point<3> &x,
                                            const TimePoint &time)
      { return named(time) * factor(x, time); };
  }
} // namespace quoin
