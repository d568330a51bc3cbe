// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_history_conditions_h
#define quoin_results_history_conditions_h

#include <quoin/stages/stage_parameters.h>
#include <quoin/results/history_parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * Conditions on the columns of histories.csv: comparisons such as
   * "abs(displacement) > 0.02 || force < 0.8*peak_force", with pi and the
   * functions of muParser. Names are those of the histories, in which _ stands
   * for each character that is no letter or digit, and stands before a digit
   * at the start; "time", that of the run [s]; and "peak_" before the name of a
   * history: its largest magnitude so far in the stage. A comparison with the
   * NaN of a history that has ended is not met.
   */
  class HistoryConditions
  {
  public:
    /**
     * @p expressions of @p histories, the names of the columns behind the time.
     * Throws an InputError that says which expression is wrong, and why,
     * without naming section or entry.
     */
    HistoryConditions(const std::vector<std::string> &expressions,
                      const std::vector<std::string> &histories);

    bool empty() const
    {
      return conditions.empty();
    }

    /**
     * Takes a @p row of histories.csv into the @p peaks of its columns, which
     * are empty where the stage begins. Returns the number of the first
     * condition that is met, or that of the conditions if none is.
     */
    std::size_t find_met(const std::vector<double> &row,
                         std::vector<double> &peaks) const;

  private:
    struct Condition
    {
      std::string expression;
      /** Names in the expression, and their indices among time, histories and
       * peaks. */
      std::vector<std::pair<std::string, std::size_t>> names;
    };

    /** Finds the names in @p expression among @p known. */
    static Condition read(const std::string &expression,
                          const std::vector<std::string> &known);
    /** Value of an expression, of which 0 is false. */
    static double value(const Condition &condition,
                        const std::vector<double> &values);

    std::vector<Condition> conditions;
  };

  /** End conditions of @p stage; throws the InputError of HistoryConditions. */
  HistoryConditions
  end_conditions(const StageParameters &stage,
                 const std::vector<HistoryParameters> &histories);
} // namespace quoin

#endif
