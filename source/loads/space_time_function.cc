// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/space_time_function.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/loads/time_function.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/utilities.h>

#include <memory>
#include <regex>
#include <sstream>

namespace quoin
{
  namespace
  {
    bool mentions(const std::string &expression, const std::string &variables)
    {
      return std::regex_search(expression,
                               std::regex("\\b[" + variables + "]\\b"));
    }
  } // namespace

  SpaceTimeFunction::SpaceTimeFunction(const std::string &given,
                                       const std::string &folder,
                                       const unsigned int dim)
  {
    const std::string names = dim == 2 ? "x, y and t" : "x, y, z and t";
    std::string text        = dealii::Utilities::trim(given);
    if (text.empty())
      throw InputError("lacks an expression of " + names + ".");
    TimeFunction named; // a table or a signal
    const bool is_named = TimeFunction::is_named(text);
    if (is_named)
    {
      const std::size_t times = text.find(" times ");
      named                   = TimeFunction(text.substr(0, times), folder);
      text    = times == std::string::npos ? "1" : text.substr(times + 7);
      on_time = true;
    }

    const auto parser = std::make_shared<dealii::FunctionParser<3>>(1);
    try
    {
      // Without z the third component has a name that no expression has.
      parser->initialize(dim == 2 ? "x,y,z_,t" : "x,y,z,t", text,
                         { { "pi", constants::pi } }, true);
      parser->value(dealii::Point<3>());
    }
    catch (const dealii::ExceptionBase &error)
    {
      std::ostringstream reason;
      error.print_info(reason);
      throw InputError("is no expression of " + names + ": " + reason.str());
    }
    on_place = mentions(text, "xyz");
    on_time  = on_time || mentions(text, "t");
    evaluate = [parser](const dealii::Point<3> &x, const double t)
    {
      parser->set_time(t);
      return parser->value(x);
    };
    if (is_named)
      evaluate = [named, factor = evaluate](const dealii::Point<3> &x,
                                            const double t) {
        return named({ t, t }) * factor(x, t);
      };
  }
} // namespace quoin
