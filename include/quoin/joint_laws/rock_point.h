// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_rock_point_h
#define quoin_joint_laws_rock_point_h

#include <quoin/joint_laws/dual_slip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace quoin
{
  class LawEntries;

  /**
   * One point of a rock joint. It is closed by V = plastic_opening - opening,
   * from which the normal traction follows, never tension; the shear traction
   * is ks (slip - plastic_slip).
   */
  template <int dim>
  struct RockPoint : JointPoint<dim>
  {
    double worn_slip = 0.; /**< sum of |dp| while closed [m] */
    double dilated   = 0.; /**< part of w that reverse slip recovers [m] */
    double reload    = 0.; /**< |tau|/strength where loading began anew [-] */
    /** tan(phi_m) at the end of the last step; 0: no law had it [-] */
    double friction = 0.;

    static constexpr std::array<double RockPoint::*, 4> internal
        = { &RockPoint::worn_slip, &RockPoint::dilated, &RockPoint::reload,
            &RockPoint::friction };
  };

  /** Shear response of a point with known closure. */
  template <int dim, typename Number>
  struct RockFlow
  {
    SlipOf<dim, Number> shear_traction{}; /**< [Pa] */
    SlipOf<dim, Number> plastic_slip{};   /**< p at the end [m] */
    Number opening  = 0.;                 /**< increment of w, dilation [m] */
    Number wear     = 0.;                 /**< increment of worn_slip [m] */
    Number reload   = 0.;                 /**< RockPoint::reload at the end */
    Number friction = 0.;                 /**< RockPoint::friction at the end */
    bool slips      = false;
  };

  /** Updated variables of a point. */
  template <int dim, typename Number>
  struct RockStep
  {
    Number closure = 0.; /**< V [m]; negative: it is open */
    RockFlow<dim, Number> flow;
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
   * @p Law: see RockLaw.
   */
  template <typename Law, int dim>
  RockStep<dim, double> find_step(const Law &law, const RockPoint<dim> &point,
                                  const double opening, const Slip<dim> &slip)
  {
    using Dual                   = DualNumber<dim>;
    constexpr double least_slope = 0.1;
    const auto constant          = constant_slip<dim, Dual>(slip);
    const double start           = point.plastic_opening - opening;
    double low                   = std::max(start, 0.);
    RockStep<dim, double> step{ 0., law.flow(point, low, slip) };
    const double first = step.flow.opening;
    step.closure       = start + first;
    if (first == 0. || step.closure <= 0.)
      return step;
    double high = first > 0. ? std::numeric_limits<double>::infinity() : low;
    if (first < 0.)
      low = 0.;
    const RockStep<dim, double> uncoupled = step;
    const double precision = 1e-14 * (std::abs(start) + std::abs(first));
    for (unsigned int i = 0; i < 60; ++i)
    {
      const Dual trial(step.closure, 0);
      const Dual rest
          = trial - start - law.flow(point, trial, constant).opening;
      if (first < 0. && rest.by[0] < least_slope)
        return uncoupled;
      (rest.value > 0. ? high : low) = step.closure;
      const double next              = step.closure - rest.value / rest.by[0];
      if (std::abs(rest.value) <= precision)
      {
        step.closure = next; // to rounding, in one more step
        break;
      }
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
  template <typename Law, int dim>
  RockStep<dim, DualNumber<dim>>
  differentiate(const Law &law, const RockPoint<dim> &point,
                const double opening, const Slip<dim> &slip,
                const RockStep<dim, double> &step)
  {
    using Dual          = DualNumber<dim>;
    const auto slip_now = variable_slip<dim>(slip);
    const Dual start(point.plastic_opening - opening, 0, -1.);
    RockStep<dim, Dual> result;
    if (!step.is_coupled)
    {
      result.flow    = law.flow(point, start, slip_now);
      result.closure = start + result.flow.opening;
      return result;
    }
    const Dual by_closure
        = law.flow(point, Dual(step.closure, 0), constant_slip<dim, Dual>(slip))
              .opening;
    const Dual rest
        = start + law.flow(point, Dual(step.closure), slip_now).opening;
    result.closure = chain(step.closure, 1. / (1. - by_closure.by[0]), rest);
    result.flow    = law.flow(point, result.closure, slip_now);
    return result;
  }

  /**
   * Updates @p point by @p step and returns the dissipation: its work by
   * the trapezoidal rule less the change of stored energy. What the rule
   * makes of the curve of the closure is left to the energy residual.
   */
  template <typename Law, int dim>
  JointDissipation take_step(const Law &law, RockPoint<dim> &point,
                             const Slip<dim> &slip,
                             const RockStep<dim, double> &step)
  {
    const bool is_open      = step.closure < 0.;
    const double sigma_old  = point.normal_traction;
    const Slip<dim> tau_old = point.shear_traction;
    const double ks_old     = law.shear_stiffness(-sigma_old);
    const double sigma  = is_open ? 0. : -law.closure.traction(step.closure);
    const Slip<dim> tau = is_open ? Slip<dim>() : step.flow.shear_traction;
    const double opened = is_open ? 0. : step.flow.opening;

    const Slip<dim> elastic = tau_old / ks_old;
    const Slip<dim> moved   = slip - point.plastic_slip - elastic;
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
      point.friction     = 0.;
      point.state        = JointState::open;
      return lost;
    }
    point.plastic_slip = step.flow.plastic_slip;
    point.plastic_opening += opened;
    point.dilated += opened;
    point.worn_slip += step.flow.wear;
    point.reload   = step.flow.reload;
    point.friction = step.flow.friction;
    if (step.flow.slips)
      point.state = JointState::slipping;
    else if (point.state != JointState::intact)
      point.state = JointState::slipped;
    return lost;
  }

  /**
   * What the laws of rock joints have in common, @p Law deriving from
   * RockLaw<Law>. It has
   *
   * - closure: traction(V), closure(s), stiffness(s) and energy(s) of the
   *   pressure s [Pa] and the closure V [m], and largest_stiffness();
   * - flow(), see find_step(), for doubles and for DualNumber;
   * - shear_stiffness(s), ks [Pa/m], and largest_shear_stiffness();
   * - initialise() and holds().
   */
  template <typename Law>
  struct RockLaw : JointLawDefaults
  {
    template <int dim>
    using Point = RockPoint<dim>;

    static constexpr const char *kind = "a law of rock joints";
    static constexpr bool stiffens    = true;

    /** Updates @p point for @p opening and @p slip [m]. */
    template <int dim>
    JointDissipation update(RockPoint<dim> &point, const double opening,
                            const Slip<dim> &slip) const
    {
      return take_step(own(), point, slip,
                       find_step(own(), point, opening, slip));
    }

    /** As update(), with the consistent tangent; see CoulombLaw. */
    template <int dim>
    JointDissipation update(RockPoint<dim> &point, const double opening,
                            const Slip<dim> &slip,
                            JointTangent<dim> &tangent) const
    {
      const auto step = find_step(own(), point, opening, slip);
      tangent         = {};
      if (step.closure >= 0.)
      {
        const auto slopes = differentiate(own(), point, opening, slip, step);
        tangent           = tangent_of(-own().closure.traction(slopes.closure),
                                       slopes.flow.shear_traction);
      }
      return take_step(own(), point, slip, step);
    }

    /** All of it is done by update_failing(). */
    template <int dim>
    bool update_elastic(RockPoint<dim> &, double, const Slip<dim> &) const
    {
      return false;
    }
    template <int dim>
    JointDissipation update_failing(RockPoint<dim> &point, const double opening,
                                    const Slip<dim> &slip) const
    {
      return update(point, opening, slip);
    }

    /** Recoverable energy per area [J/m^2]. */
    template <int dim>
    double stored_energy(const RockPoint<dim> &point,
                         double /*opening*/ = 0.) const
    {
      return own().closure.energy(-point.normal_traction)
             + 0.5 * point.shear_traction * point.shear_traction
                   / own().shear_stiffness(-point.normal_traction);
    }

    /** See CoulombLaw. */
    template <int dim>
    double carried_energy(const RockPoint<dim> &before,
                          const RockPoint<dim> &after) const
    {
      return 0.5 * stored_energy(before) + 0.5 * stored_energy(after);
    }

    /** kn and ks [Pa/m] at the normal traction @p sigma [Pa], and at most. */
    std::array<double, 2> stiffness_at(const double sigma) const
    {
      return { own().closure.stiffness(-sigma), own().shear_stiffness(-sigma) };
    }
    std::array<double, 2> largest_stiffness() const
    {
      return { own().closure.largest_stiffness(),
               own().largest_shear_stiffness() };
    }

    /** New contacts have the smallest roughness that slip can lead to. */
    template <int dim>
    void wear_out(RockPoint<dim> &point) const
    {
      point.worn_slip = std::numeric_limits<double>::infinity();
    }

  private:
    const Law &own() const
    {
      return static_cast<const Law &>(*this);
    }
  };

  /** phi_r [rad], which must be given. */
  double read_residual_angle(LawEntries &entries);

  /** Refuses cohesion, tension and dilation, which follow from the rest. */
  void refuse_bond(LawEntries &entries);
} // namespace quoin

#endif
