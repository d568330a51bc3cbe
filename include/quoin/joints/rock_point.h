// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_rock_point_h
#define quoin_joints_rock_point_h

#include <quoin/base/state.h>
#include <quoin/joints/coulomb_law.h>
#include <quoin/joints/dual_number.h>
#include <quoin/joints/joint_tangent.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  /**
   * One point of a rock joint, as BartonBandisLaw and ContinuouslyYieldingLaw
   * read and overwrite it: the arrays of the same names in JointHistory, all of
   * which begin with 0.
   *
   * The joint is closed by V = plastic_opening - opening, from which the
   * normal traction follows; the shear traction is ks (slip - plastic_slip).
   */
  struct RockPoint
  {
    double normal_traction = 0.; /**< sigma [Pa], tension positive, never so */
    double shear_traction  = 0.; /**< tau [Pa] */
    double plastic_slip    = 0.; /**< p [m] */
    double plastic_opening = 0.; /**< w [m]: dilation and offset */
    double worn_slip       = 0.; /**< sum of |dp| while closed [m] */
    double dilated         = 0.; /**< of w, what slip back takes back [m] */
    double reload    = 0.; /**< |tau|/strength where loading began anew [-] */
    JointState state = JointState::intact;
  };

  /** What slip does to a point whose closure is known. */
  template <typename Number>
  struct RockFlow
  {
    Number shear_traction = 0.; /**< [Pa] */
    Number plastic_slip   = 0.; /**< p at the end [m] */
    Number opening        = 0.; /**< what w grows by, dilation [m] */
    Number wear           = 0.; /**< what worn_slip grows by [m] */
    Number reload         = 0.; /**< as RockPoint's, at the end */
    bool slips            = false;
  };

  /** What a point comes to. */
  template <typename Number>
  struct RockStep
  {
    Number closure = 0.; /**< V [m]; negative: it is open */
    RockFlow<Number> flow;
    bool is_coupled = false; /**< flow is that at V, not at V0 */
  };

  /**
   * The step of a point to @p opening and @p slip [m]: flow at the closure V
   * that it leads to, the root of V - V0 - flow(V).opening, V0 = w - opening,
   * by Newton's method within a bracket. Dilation presses the joint together,
   * and depends little on how much it is pressed. A joint that closes by
   * slipping back loses strength, and so much of it that there may be no
   * root nearby, if kn is far above ks: then it flows at V0.
   *
   * @p Law: BartonBandisLaw or ContinuouslyYieldingLaw.
   */
  template <typename Law>
  RockStep<double> find_step(const Law &law, const RockPoint &point,
                             const double opening, const double slip)
  {
    constexpr double least_slope = 0.1;
    const double start           = point.plastic_opening - opening;
    double low                   = std::max(start, 0.);
    RockStep<double> step{ 0., law.flow(point, low, slip) };
    const double first = step.flow.opening;
    step.closure       = start + first;
    if (first == 0. || step.closure <= 0.)
      return step;
    double high = first > 0. ? std::numeric_limits<double>::infinity() : low;
    if (first < 0.)
      low = 0.;
    const RockStep<double> uncoupled = step;
    const double precision = 1e-14 * (std::abs(start) + std::abs(first));
    for (unsigned int i = 0; i < 60; ++i)
    {
      const DualNumber trial(step.closure, 1., 0.);
      const DualNumber rest
          = trial - start - law.flow(point, trial, DualNumber(slip)).opening;
      if (first < 0. && rest.by[0] < least_slope)
        return uncoupled;
      (rest.value > 0. ? high : low) = step.closure;
      if (std::abs(rest.value) <= precision)
        break;
      const double next = step.closure - rest.value / rest.by[0];
      if (next > low && next < high)
        step.closure = next;
      else if (std::isfinite(high))
        step.closure = 0.5 * (low + high);
      else
        step.closure += 2. * std::abs(rest.value);
    }
    step.flow       = law.flow(point, step.closure, slip);
    step.is_coupled = true;
    return step;
  }

  /** The derivatives of @p step by opening and slip. */
  template <typename Law>
  RockStep<DualNumber> differentiate(const Law &law, const RockPoint &point,
                                     const double opening, const double slip,
                                     const RockStep<double> &step)
  {
    const DualNumber slip_now(slip, 0., 1.);
    const DualNumber start(point.plastic_opening - opening, -1., 0.);
    RockStep<DualNumber> result;
    if (!step.is_coupled)
    {
      result.flow    = law.flow(point, start, slip_now);
      result.closure = start + result.flow.opening;
      return result;
    }
    const DualNumber by_closure
        = law.flow(point, DualNumber(step.closure, 1., 0.), DualNumber(slip))
              .opening;
    const DualNumber rest
        = start + law.flow(point, DualNumber(step.closure), slip_now).opening;
    const double slope = 1. - by_closure.by[0];
    result.closure
        = DualNumber(step.closure, rest.by[0] / slope, rest.by[1] / slope);
    result.flow = law.flow(point, result.closure, slip_now);
    return result;
  }

  /**
   * Brings @p point to @p step and returns what that dissipated: its work by
   * the trapezoidal rule less the change of stored energy. What the rule
   * makes of the curve of the closure is left to the energy residual.
   */
  template <typename Law>
  JointDissipation take_step(const Law &law, RockPoint &point,
                             const double slip, const RockStep<double> &step)
  {
    const bool is_open     = step.closure < 0.;
    const double sigma_old = point.normal_traction;
    const double tau_old   = point.shear_traction;
    const double ks_old    = law.shear_stiffness(-sigma_old);
    const double sigma     = is_open ? 0. : -law.closure.traction(step.closure);
    const double tau       = is_open ? 0. : step.flow.shear_traction;
    const double opened    = is_open ? 0. : step.flow.opening;

    const double elastic = tau_old / ks_old;
    const double moved   = slip - point.plastic_slip - elastic;
    JointDissipation lost;
    lost.friction = 0.5 * (tau_old + tau) * moved + 0.5 * tau_old * elastic
                    - 0.5 * tau * tau / law.shear_stiffness(-sigma)
                    + 0.5 * (sigma_old + sigma) * opened;

    point.normal_traction = sigma;
    point.shear_traction  = tau;
    if (is_open)
    {
      point.plastic_slip = slip;
      point.reload       = 0.;
      point.state        = JointState::open;
      return lost;
    }
    point.plastic_slip = step.flow.plastic_slip;
    point.plastic_opening += opened;
    point.dilated += opened;
    point.worn_slip += step.flow.wear;
    point.reload = step.flow.reload;
    if (step.flow.slips)
      point.state = JointState::slipping;
    else if (point.state != JointState::intact)
      point.state = JointState::slipped;
    return lost;
  }

  template <typename Law>
  JointDissipation update_rock(const Law &law, RockPoint &point,
                               const double opening, const double slip)
  {
    return take_step(law, point, slip, find_step(law, point, opening, slip));
  }

  /** The same with the consistent tangent. */
  template <typename Law>
  JointDissipation update_rock(const Law &law, RockPoint &point,
                               const double opening, const double slip,
                               JointTangent &tangent)
  {
    const RockStep<double> step = find_step(law, point, opening, slip);
    tangent                     = {};
    if (step.closure >= 0.)
    {
      const auto slopes      = differentiate(law, point, opening, slip, step);
      const DualNumber sigma = -law.closure.traction(slopes.closure);
      const DualNumber tau   = slopes.flow.shear_traction;
      tangent = { sigma.by[0], sigma.by[1], tau.by[0], tau.by[1] };
    }
    return take_step(law, point, slip, step);
  }
} // namespace quoin

#endif
