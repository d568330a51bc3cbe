// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_time_function_h
#define quoin_signals_time_function_h

#include <quoin/signals/signal.h>
#include <quoin/operators/step_context.h>

#include <functional>
#include <string>
#include <utility>

namespace quoin
{
  /** Time in a stage after which loads are taken as constant [s]. */
  constexpr double late_time = 1e9;

  /** Half a cosine from 0 at @p time 0 to 1 at @p duration [s], and 1 beyond; 1
      without duration. */
  double half_cosine(double time, double duration);

  /** Growth of a load by half a cosine, of which a part may have passed in the
      stages before. */
  struct Growth
  {
    double duration = 0.; /**< of all of it [s]; 0: the load is there */
    double passed   = 0.; /**< before the stage [s] */

    /** Share of the load at the time @p load_time of the stage [-]. */
    double share(const double load_time) const
    {
      return half_cosine(passed + load_time, duration);
    }
    /** How long it takes from the start of the stage on [s]. */
    double rest() const
    {
      return passed < duration ? duration - passed : 0.;
    }
    /** Returns this growth counted from @p load_time of the stage on [s]. */
    Growth after(const double load_time) const
    {
      const Growth later{ duration, passed + load_time };
      return later.rest() > 0. ? later : Growth();
    }

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(duration, passed);
    }
  };

  /**
   * A value that depends on time alone: an expression of t (time in the
   * stage) and T (total time), with pi and the functions of muParser,
   * if(condition, a, b) among them; or "table FILE", a CSV file of times [s] in
   * the stage and values, linear in between and constant beyond its ends; or a
   * signal of the time in the stage, such as "wavelet Ricker 5" (see
   * read_signal()). "times EXPRESSION" after a table or a signal multiplies it.
   */
  class TimeFunction
  {
  public:
    TimeFunction() = default;

    /**
     * Reads @p text. File names are relative to @p folder. Throws an InputError
     * that says what is wrong, without naming section or parameter.
     */
    TimeFunction(const std::string &text, const std::string &folder);

    explicit TimeFunction(std::function<double(const TimePoint &)> function)
      : evaluate(std::move(function)), constant(false)
    {
    }

    /** Whether @p text begins like a table or a signal. */
    static bool is_named(const std::string &text);

    /** Whether the expression in @p text, which may be none, names T. */
    static bool names_total(const std::string &text);

    double operator()(const TimePoint &time) const
    {
      return evaluate(time);
    }

    /** Whether it is a number, the same at all times. */
    bool is_constant() const
    {
      return constant;
    }

    /** The function of the time since the start of a run with one stage. */
    Signal signal() const;

  private:
    std::function<double(const TimePoint &)> evaluate
        = [](const TimePoint &) { return 0.; };
    bool constant = true;
    Signal known; /**< without value unless it is a signal alone */
  };
} // namespace quoin

#endif
