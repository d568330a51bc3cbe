// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_space_time_function_h
#define quoin_signals_space_time_function_h

#include <quoin/base/eigen_core.h>
#include <quoin/operators/step_context.h>

#include <deal.II/base/point.h>

#include <functional>
#include <string>

namespace quoin
{
  /**
   * A value that depends on place and time: an expression of x, y, in three
   * dimensions z [m] and t [s], with pi and the functions of muParser,
   * if(condition, a, b) among them; or "table FILE" or a signal, such as "pulse
   * triangular 1e-3 5e-3", as in TimeFunction; or one of these and "times
   * EXPRESSION", the product of the two.
   */
  class SpaceTimeFunction
  {
  public:
    /** Zero. */
    SpaceTimeFunction() = default;

    /**
     * Reads @p text, of x and y or, with @p dim = 3, of x, y and z. File names
     * are relative to @p folder. With @p of_stage the time t is that in the
     * stage, and T, the total time, may stand in expressions without z. Throws
     * an InputError that says what is wrong, without naming section or
     * parameter.
     */
    SpaceTimeFunction(const std::string &text, const std::string &folder,
                      unsigned int dim = 2, bool of_stage = false);

    /** Whether the expression in @p text, which may be none, names x, y or z.
     */
    static bool names_place(const std::string &text);

    /** Value at the position @p x [m] and the time [s]. */
    double operator()(const dealii::Point<3> &x, const TimePoint &time) const
    {
      return evaluate(x, time);
    }
    double operator()(const dealii::Point<3> &x, const double t) const
    {
      return evaluate(x, { t, t });
    }
    double operator()(const dealii::Point<2> &x, const double t) const
    {
      return evaluate({ x[0], x[1], 0. }, { t, t });
    }

    /** Whether the value may differ between points. */
    bool depends_on_place() const
    {
      return on_place;
    }

    /** Whether it is an expression of z. */
    bool depends_on_z() const
    {
      return on_z;
    }

    /** Whether the value may change in time. */
    bool depends_on_time() const
    {
      return on_time;
    }

  private:
    std::function<double(const dealii::Point<3> &, const TimePoint &)> evaluate
        = [](const dealii::Point<3> &, const TimePoint &) { return 0.; };
    bool on_place = false;
    bool on_z     = false;
    bool on_time  = false;
  };
} // namespace quoin

#endif
