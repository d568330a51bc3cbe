// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_steps.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Factors of the step after a failure and, at most, after success. */
    constexpr double cut_factor  = 0.3;
    constexpr double most_growth = 1.5;
    /** Ratio of unbalanced to applied force where a load step is predicted, up
        to which it may be longer than the first one, and safety factor on the
        step for this ratio, which grows with its square. */
    constexpr double predicted_ratio = 2e-4, prediction_safety = 0.9;
    /** Load step by the last one below which the path is followed. */
    constexpr double path_share = 0.1;
    /** Pseudo-time steps of a jump: drag is a typical stiffness over these. */
    constexpr double first_drag_step = 0.1, least_drag_step = 1e-9;
    constexpr double drag_growth = 2., drag_cut = 0.2;
    /** Path increment in a step of a jump, by the largest path step or, if that
        is more, by the path of the jump so far, as of cracks that open wide;
        where a search for the factor of safety asks whether the model goes on
        moving. */
    constexpr double most_flow = 1., long_flow = 0.02, safety_flow = 0.2;
    /** Ratio of drag to applied force up to which the loads of a jump may go
       on, and share of it that they are slowed down to: a drag beyond would
       hold the model while prescribed motions go on, and let joints yield
       elsewhere than without it. */
    constexpr double most_drag = 0.02, wanted_drag = 0.5;
    /** Growth of their rate where drag is a small part of that. */
    constexpr double rate_growth = 4.;
    /** Load step after a jump, by the last one. */
    constexpr double jump_share = 0.3;
    /** Steps ahead on the path before return to load control. */
    constexpr unsigned int steps_ahead = 5;
  } // namespace

  void ImplicitSteps::begin_stage(const double duration, const bool loads_rest,
                                  const bool safety)
  {
    stage_end       = duration;
    rests           = loads_rest;
    searches_factor = safety;
  }

  void ImplicitSteps::begin_release(ImplicitState &now) const
  {
    now.released  = 0.;
    now.step      = parameters.first_step;
    now.last_step = now.step;
  }

  void ImplicitSteps::begin_loads(ImplicitState &now) const
  {
    now.released  = 1.;
    now.step      = first_load_step();
    now.last_step = 0.;
  }

  StepTarget ImplicitSteps::target(const ImplicitState &now,
                                   const double time) const
  {
    if (now.jumps)
      return { now.jump_rate > 0. ? std::min(
                   now.jump_time, time + now.jump_rate * now.drag_step)
                                  : now.jump_time,
               now.jump_released, 0. };
    if (now.released < 1.)
    {
      const double next = now.released + now.step;
      return { time, next > 1. - 1e-9 ? 1. : next, 0. };
    }
    double next = time + now.step * stage_end;
    if (now.follows_path)
      return { next, 1., now.path_step };
    if (next > stage_end * (1. - 1e-9))
      next = stage_end;
    return { next, 1., 0. };
  }

  double ImplicitSteps::most_jump_path(const ImplicitState &now) const
  {
    return std::max(most_flow * parameters.largest_path_step,
                    (searches_factor ? safety_flow : long_flow)
                        * now.drag_path);
  }

  bool ImplicitSteps::begin_jump(const double time, ImplicitState &now) const
  {
    // A search for the factor of safety asks whether the model keeps moving.
    if (!searches_factor && !parameters.jumps)
      return false;
    now.follows_path   = false;
    now.jumps          = true;
    now.moved_for      = 0.;
    now.n_drag         = 0;
    now.drag_time      = 0.;
    now.drag_path      = 0.;
    now.watched_from   = 0;
    now.watched_drag   = 0.;
    now.jump_loss      = 0.;
    now.drag_step      = first_drag_step;
    now.jump_rate      = 0.;
    now.jump_time      = time;
    now.jump_released  = 1.;
    const double share = std::max({ now.step, jump_share * now.last_step,
                                    2. * parameters.smallest_step });
    if (now.released < 1. && !searches_factor)
      now.jump_released = std::min(1., now.released + share);
    else // loads that rest are there all at once
      now.jump_time
          = rests ? stage_end
                  : std::min(stage_end, now.jump_time + share * stage_end);
    return true;
  }

  void ImplicitSteps::adapt_jump(const unsigned int n_iterations,
                                 const double path, ImplicitState &now) const
  {
    if (n_iterations <= parameters.wanted_iterations
        && std::abs(path) < most_jump_path(now) / drag_growth)
      now.drag_step *= drag_growth;
  }

  bool ImplicitSteps::slows_loads(const StepTarget &target, const double ratio,
                                  const double last, const double time,
                                  ImplicitState &now) const
  {
    const double advance = target.load_time - time;
    if (!now.jumps || searches_factor || rests || advance <= 0.)
      return false;
    const double rate = advance / now.drag_step;
    if (ratio > most_drag && ratio < 0.9 * last)
    {
      now.jump_rate = wanted_drag * most_drag / ratio * rate;
      return true;
    }
    if (now.jump_rate > 0. && ratio < wanted_drag / rate_growth * most_drag)
      now.jump_rate *= rate_growth;
    return false;
  }

  void ImplicitSteps::end_jump(const ImplicitState &before,
                               ImplicitState &now) const
  {
    now.jumps      = false;
    now.after_jump = true;
    now.moved_for  = 0.;
    now.path_step  = 0.;
    if (before.released < 1.)
    {
      now.last_step = now.released - before.released;
      now.step      = now.last_step;
      if (now.released == 1.)
        begin_loads(now);
      return;
    }
    // After a short jump the equilibrium is the next one on the same path. One
    // that begins where another ended is one of many, by which a mechanism goes
    // on.
    const double next
        = now.last_step
          * (now.n_drag <= short_jump || before.after_jump ? most_growth
                                                           : jump_share);
    now.last_step = std::clamp(next, 0.01 * parameters.first_step,
                               parameters.largest_step);
    now.step      = now.last_step;
  }

  bool ImplicitSteps::cut(const bool measures_path, const double time,
                          ImplicitState &now) const
  {
    if (now.jumps)
    {
      // Loads that come slowly do not move the model by more against the drag.
      if (now.jump_rate == 0. && now.jump_time > time)
        now.jump_rate = drag_cut * (now.jump_time - time) / now.drag_step;
      now.drag_step *= drag_cut;
      return now.drag_step > least_drag_step;
    }
    if (now.follows_path)
    {
      now.path_step *= cut_factor;
      now.step *= cut_factor;
      return now.path_step
                 > path_share * path_share * parameters.largest_path_step
             || begin_jump(time, now);
    }
    const double last_step
        = std::max(now.last_step, 0.1 * parameters.first_step);
    now.step *= cut_factor;
    if (parameters.path != PathFollowing::never && now.released == 1.
        && measures_path && now.step < path_share * last_step)
    {
      now.follows_path = true;
      now.ahead        = 0;
      now.step         = 0.5 * last_step;
      now.path_step    = now.path_step > 0.
                             ? 0.5 * now.path_step
                             : path_share * parameters.largest_path_step;
      return true;
    }
    if (now.step < path_share * last_step && begin_jump(time, now))
      return true;
    return now.step >= parameters.smallest_step;
  }

  double ImplicitSteps::longest_step(const double went,
                                     const double error) const
  {
    if (error == 0.)
      return parameters.largest_step;
    return std::clamp(prediction_safety * std::sqrt(predicted_ratio / error)
                          * went,
                      parameters.first_step, parameters.largest_step);
  }

  bool ImplicitSteps::is_too_long(const double time, const StepTarget &target,
                                  const double error) const
  {
    return error > predicted_ratio
           && target.load_time - time
                  > (1. + 1e-9) * parameters.first_step * stage_end;
  }

  void ImplicitSteps::shorten(const StepTarget &target, const double error,
                              const double time, ImplicitState &now) const
  {
    now.step = longest_step((target.load_time - time) / stage_end, error);
  }

  template <int dim>
  void ImplicitSteps::adapt(const State<dim> &before,
                            const unsigned int n_iterations, const double error,
                            const double path, State<dim> &state) const
  {
    ImplicitState &now = state.template get<ImplicitState>();
    now.after_jump     = false;
    const double went
        = before.template get<ImplicitState>().released < 1.
              ? now.released - before.template get<ImplicitState>().released
              : (state.load_time - before.load_time) / stage_end;
    const double growth
        = std::min(most_growth, std::sqrt(double(parameters.wanted_iterations)
                                          / std::max(1U, n_iterations)));
    if (before.template get<ImplicitState>().released < 1.)
    {
      now.last_step = went;
      now.step      = std::min(growth * std::max(went, now.step),
                               parameters.largest_step);
      if (now.released == 1.)
        begin_loads(now);
      return;
    }
    now.path_length += path;
    now.farthest = std::max(now.farthest, state.load_time);
    if (now.follows_path)
    {
      const double longer
          = std::min(growth, parameters.largest_path_step / now.path_step);
      now.path_step *= longer;
      // Loads advance first, so that joints yield; the path then decides.
      now.step
          = std::clamp(longer * std::abs(went), 0.01 * parameters.first_step,
                       parameters.largest_step);
      now.ahead
          = went > 0. && state.load_time >= now.farthest ? now.ahead + 1 : 0;
      if (now.ahead > steps_ahead && parameters.path != PathFollowing::always)
        now.follows_path = false;
    }
    else
    {
      now.path_step = std::min(path, parameters.largest_path_step);
      now.last_step = went;
      now.step      = std::min(growth * std::max(went, now.step),
                               longest_step(went, error));
      if (parameters.path == PathFollowing::always
          && path > 1e-3 * parameters.largest_path_step)
        now.follows_path = true;
    }
  }

  template void ImplicitSteps::adapt(const State<2> &, unsigned int, double,
                                     double, State<2> &) const;
  template void ImplicitSteps::adapt(const State<3> &, unsigned int, double,
                                     double, State<3> &) const;
} // namespace quoin
