// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/history_conditions.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/expression.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>

#include <deal.II/base/function_parser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace quoin
{
  namespace
  {
    /** Letters of the longest name that muParser takes. */
    constexpr std::size_t longest_name = 100;

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

    /** The words of an expression, without its functions. */
    std::vector<std::string> words_of(const std::string &expression)
    {
      // By hand: a regular expression uses stack for each character, which a
      // long name exhausts.
      const std::string digits = "0123456789", of_number = digits + ".",
                        letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "abcdefghijklmnopqrstuvwxyz_";
      const auto past = [&](const std::string &these, const std::size_t begin)
      {
        return std::min(expression.find_first_not_of(these, begin),
                        expression.size());
      };
      std::vector<std::string> words;
      for (std::size_t i = expression.find_first_of(of_number + letters), end;
           i < expression.size();
           i = expression.find_first_of(of_number + letters, end))
        if (end = past(of_number, i); end > i)
        {
          // The e of 1e-3 is no word.
          const std::size_t e = past("eE", end), sign = past("+-", e);
          if (e == end + 1 && sign <= e + 1 && past(digits, sign) > sign)
            end = past(digits, sign);
        }
        else
        {
          end                     = past(letters + digits, i);
          const std::size_t after = past(" \t", end);
          if (after == expression.size() || expression[after] != '(')
            words.push_back(expression.substr(i, end - i));
        }
      return words;
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
    for (const std::string &name : words_of(expression))
    {
      if (name == "pi")
        continue;
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        throw InputError(begin + "but '" + name + "' is no history. Known are: "
                         + known_names_like(name, known) + ".");
      if (std::count(known.begin(), known.end(), name) > 1)
        throw InputError(begin + "but '" + name
                         + "' may mean two of the histories, of the time and "
                           "of the peaks. Rename one in section 'Histories'.");
      if (name.size() > longest_name)
        throw InputError(begin + "but '" + name + "' has more than "
                         + std::to_string(longest_name)
                         + " letters, too many for a condition. Take a "
                           "shorter name in section 'Histories'.");
      condition.names.emplace_back(name, found - known.begin());
    }
    if (condition.names.empty())
      throw InputError(begin + "which names no history. Known are: "
                       + known_names(known) + ".");
    parse_expression(
        expression, begin + "which is no expression",
        [&]() { value(condition, std::vector<double>(known.size(), 0.)); });
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
