// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/expression.h>
#include <quoin/signals/signal_text.h>
#include <quoin/signals/time_function.h>
#include <quoin/signals/time_table.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/utilities.h>

#include <boost/lexical_cast/try_lexical_convert.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <regex>

namespace quoin
{
  TimeFunction::TimeFunction(const std::string &given,
                             const std::string &folder)
  {
    std::string text    = dealii::Utilities::trim(given);
    const bool is_named = TimeFunction::is_named(text);
    double number       = 0.;
    constant = !is_named && boost::conversion::try_lexical_convert(text, number)
               && std::isfinite(number);
    if (constant)
    {
      evaluate = [number](const TimePoint &) { return number; };
      return;
    }
    if (is_named)
    {
      const std::size_t times = text.find(" times ");
      const std::string named = text.substr(0, times);
      if (is_signal_text(named))
      {
        const Signal signal = read_signal(named, folder);
        evaluate            = [value = signal.value](const TimePoint &time)
        { return value(time.stage); };
        if (times == std::string::npos)
          known = signal;
      }
      else
      {
        const std::string name = dealii::Utilities::trim(named.substr(5));
        if (name.empty())
          throw InputError("names no file: give 'table FILE' or 'table FILE "
                           "times' and an expression.");
        const auto table = std::make_shared<const TimeTable>(
            read_time_table(name.front() == '/' ? name : folder + name));
        evaluate = [table](const TimePoint &time)
        { return interpolate(*table, time.stage); };
      }
      if (times == std::string::npos)
        return;
      text = text.substr(times + 7);
    }

    const auto parser = std::make_shared<dealii::FunctionParser<2>>(1);
    parse_expression(
        text, "is no expression of t and T",
        [&]()
        {
          parser->initialize("t,T", text, { { "pi", constants::pi } });
          parser->value(dealii::Point<2>(0., 0.));
        });
    const auto expression = [parser](const TimePoint &time)
    { return parser->value(dealii::Point<2>(time.stage, time.total)); };
    const double moments[] = { 0., 0.37, 41., 5e3 };
    if (std::none_of(std::begin(moments), std::end(moments),
                     [&](const double t) {
                       return std::isfinite(expression({ t, t }));
                     }))
      throw InputError("is no finite number at any time.");
    if (is_named)
      evaluate = [named = evaluate, expression](const TimePoint &time)
      { return named(time) * expression(time); };
    else
      evaluate = expression;
  }

  double half_cosine(const double time, const double duration)
  {
    return duration > 0. && time < duration
               ? 0.5 * (1. - std::cos(constants::pi * time / duration))
               : 1.;
  }

  bool TimeFunction::is_named(const std::string &text)
  {
    return text.rfind("table ", 0) == 0 || is_signal_text(text);
  }

  bool TimeFunction::names_total(const std::string &text)
  {
    const std::string trimmed = dealii::Utilities::trim(text);
    const std::size_t times   = trimmed.find(" times ");
    const std::size_t begin   = !is_named(trimmed)           ? 0
                                : times == std::string::npos ? trimmed.size()
                                                             : times + 7;
    static const std::regex total("\\bT\\b");
    return std::regex_search(trimmed.substr(begin), total);
  }

  Signal TimeFunction::signal() const
  {
    if (known.value)
      return known;
    Signal result;
    result.value = [f = evaluate](const double t) { return f({ t, t }); };
    return result;
  }
} // namespace quoin
