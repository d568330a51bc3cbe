// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/history_conditions.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>

#include <deal.II/base/function_parser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** @p name as muParser can read it. */
    std::string identifier(const std::string &name)
    {
      const auto is_digit_or_letter
          = [](const unsigned char c) { return c < 128 && std::isalnum(c); };
      std::string result;
      for (const char c : name)
        result += is_digit_or_letter(c) ? c : '_';
      return !result.empty() && std::isdigit(result.front()) ? "_" + result
                                                             : result;
    }
  } // namespace

  HistoryConditions::HistoryConditions(
      const std::vector<std::string> &expressions,
      const std::vector<std::string> &histories)
  {
    std::vector<std::string> known = { "time" };
    for (const std::string prefix : { "", "peak_" })
      for (const std::string &history : histories)
        known.push_back(prefix + identifier(history));
    for (const std::string &expression : expressions)
      conditions.push_back(read(expression, known));
  }

  HistoryConditions::Condition
  HistoryConditions::read(const std::string &expression,
                          const std::vector<std::string> &known)
  {
    Condition condition{ expression, {} };
    const std::string begin = "has the condition '" + expression + "', ";
    if (expression.find_first_of("<>=") == std::string::npos)
      throw InputError(begin
                       + "which compares nothing. Use <, >, <= or >=, as in "
                         "abs(displacement) > 0.02.");
    // Numbers go first, or the e of 1e-3 would be a name.
    static const std::regex word(
        R"((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[A-Za-z_]\w*(\s*\()?)");
    for (std::sregex_iterator i(expression.begin(), expression.end(), word),
         end;
         i != end; ++i)
    {
      const std::string name = i->str();
      const bool is_function = (*i)[1].matched;
      if (is_function || name == "pi" || std::isdigit(name[0])
          || name[0] == '.')
        continue;
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        throw InputError(begin + "but '" + name + "' is no history. Known are: "
                         + known_names(nearest_first(name, known)) + ".");
      if (std::count(known.begin(), known.end(), name) > 1)
        throw InputError(begin + "but '" + name
                         + "' may mean two of the histories, of the time and "
                           "of the peaks. Rename one in section 'Histories'.");
      condition.names.emplace_back(name, found - known.begin());
    }
    if (condition.names.empty())
      throw InputError(begin + "which names no history. Known are: "
                       + known_names(known) + ".");
    try
    {
      value(condition, std::vector<double>(known.size(), 0.));
    }
    catch (const dealii::ExceptionBase &error)
    {
      std::ostringstream reason;
      error.print_info(reason);
      throw InputError(begin + "which is no expression: " + reason.str());
    }
    return condition;
  }

  double HistoryConditions::value(const Condition &condition,
                                  const std::vector<double> &values)
  {
    // The parser takes as many variables as there are dimensions, but any
    // number of constants; a row is written seldom enough to parse anew.
    std::map<std::string, double> constants = { { "pi", constants::pi } };
    for (const auto &[name, place] : condition.names)
      constants[name] = values[place];
    dealii::FunctionParser<1> parser(1);
    parser.initialize("x_", condition.expression, constants);
    return parser.value(dealii::Point<1>());
  }

  std::size_t HistoryConditions::find_met(const std::vector<double> &row,
                                          std::vector<double> &peaks) const
  {
    const std::size_t n = row.size() - 1;
    peaks.resize(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
      peaks[i] = std::fmax(peaks[i], std::abs(row[1 + i]));
    std::vector<double> values = row;
    values.insert(values.end(), peaks.begin(), peaks.end());
    const auto met = std::find_if(conditions.begin(), conditions.end(),
                                  [&](const Condition &condition)
                                  { return value(condition, values) != 0.; });
    return met - conditions.begin();
  }

  HistoryConditions
  end_conditions(const StageParameters &stage,
                 const std::vector<HistoryParameters> &histories)
  {
    std::vector<std::string> expressions, names;
    for (const EndCondition &condition : stage.end_conditions)
      expressions.push_back(condition.expression);
    for (const HistoryParameters &history : histories)
      names.push_back(history.name);
    return HistoryConditions(expressions, names);
  }
} // namespace quoin
