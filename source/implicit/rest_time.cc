// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/implicit/rest_time.h>

namespace quoin
{
  template <int dim>
  double rest_time(const StageLoads<dim> &acting, const StageParameters &stage,
                   const double stage_start)
  {
    const auto values
        = [&](const double t) { return acting.values(stage_start, t); };
    constexpr double earliest = 1e-9; // [s]
    const auto last           = values(late_time);
    if (values(1.7 * late_time) != last)
      throw InputError("section 'Stages/" + stage.name
                       + "': 'End = static ratio', but its loads never become "
                         "constant. Take 'End = time' and a 'Duration', or "
                         "functions of time that become constant.");
    double rests = late_time, moves = 0.;
    for (double t = late_time; t > earliest; t *= 0.9)
      if (values(t) == last)
        rests = t;
      else
      {
        moves = t;
        break;
      }
    if (moves == 0. && values(0.) == last)
      rests = 0.;
    while (rests > earliest && rests - moves > 1e-9 * rests)
    {
      const double middle                      = 0.5 * (rests + moves);
      (values(middle) == last ? rests : moves) = middle;
    }
    // Loads that jump at the start of the stage are constant from then on.
    return rests > earliest ? rests : 0.;
  }

  template double rest_time(const StageLoads<2> &, const StageParameters &,
                            double);
  template double rest_time(const StageLoads<3> &, const StageParameters &,
                            double);
} // namespace quoin
