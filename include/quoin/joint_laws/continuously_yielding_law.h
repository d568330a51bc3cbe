// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_continuously_yielding_law_h
#define quoin_joint_laws_continuously_yielding_law_h

#include <quoin/joint_laws/rock_point.h>

#include <string>

namespace quoin
{
  /**
   * A stiffness that goes with a power of the pressure, k = kr (s/sr)^e, and
   * is constant below a lowest and above a highest pressure; e in [0, 1].
   */
  struct PowerStiffness
  {
    double reference          = 0.; /**< kr [Pa/m] */
    double exponent           = 0.; /**< e [-] */
    double reference_traction = 1.; /**< sr [Pa] */
    double lowest             = 0.; /**< [Pa] */
    double highest            = 0.; /**< [Pa] */

    /** k [Pa/m] at s [Pa]. */
    template <typename Number>
    Number at(const Number &traction) const
    {
      using std::pow;
      if (exponent == 0.)
        return reference;
      const double s = value_of(traction);
      if (s <= lowest || s >= highest)
        return reference
               * std::pow((s <= lowest ? lowest : highest) / reference_traction,
                          exponent);
      return reference * pow(traction / reference_traction, exponent);
    }
  };

  /** The closure whose slope is a PowerStiffness: ds = kn(s) dV. */
  class PowerClosure
  {
  public:
    explicit PowerClosure(const PowerStiffness &stiffness);

    /** s [Pa] at the closure V [m]; none if that is negative. Its derivative
        at zero is that of closing. */
    template <typename Number>
    Number traction(const Number &closure) const
    {
      using std::exp;
      using std::pow;
      const double V = value_of(closure);
      if (V < 0.)
        return 0.;
      if (V <= low_closure)
        return low_stiffness * closure;
      if (V >= high_closure)
        return law.highest + high_stiffness * (closure - high_closure);
      const Number x = (closure - low_closure) * (low_stiffness / law.lowest);
      const double e = 1. - law.exponent;
      if (e == 0.)
        return law.lowest * exp(x);
      return law.lowest * pow(1. + e * x, 1. / e);
    }

    /** V [m] at s [Pa]. */
    double closure(double traction) const;

    /** ds/dV [Pa/m] at s [Pa]. */
    double stiffness(const double traction) const
    {
      return law.at(traction);
    }

    /** Recoverable energy per area [J/m^2] at s [Pa]. */
    double energy(double traction) const;

    double largest_stiffness() const
    {
      return high_stiffness;
    }

  private:
    template <typename Law, int lanes, int dim>
    friend class LawLanes;

    PowerStiffness law;
    double low_stiffness, high_stiffness; /**< [Pa/m] */
    double low_closure, high_closure;     /**< range of the power law [m] */
  };

  /**
   * The continuously yielding joint of @cite CundallHart1984, @cite Lemos1987
   * and @cite CundallLemos1990, which has no elastic range in loading:
   *
   *     ds = kn(s) dV,  dtau = F ks(s) du,  F = (1 - |tau|/tau_m)/(1 - r),
   *     tau_m = s tan(phi_m),  dphi_m = -(phi_m - phi)/R dp,  dp = (1 - F)|du|,
   *
   * so that phi_m = phi + (phi_m0 - phi) exp(-p/R). r is |tau|/tau_m where
   * slip last turned to load again, at most 0.75; F is at most 1, and negative
   * where wear has left |tau| above tau_m. The joint dilates by tan(i) dp,
   * i = atan(|tau|/s) - phi, between zero and phi_m0 - phi.
   *
   * Where the law is replaced by a weaker one, or replaces that of Barton and
   * Bandis, |tau| falls to tau_m at once, by plastic slip. By the rates alone
   * it would wait for slip, and a joint at rest would bear more than its
   * strength. Where the pressure falls it does wait.
   *
   * Slip against the traction unloads: it is elastic, F = 1, and beyond zero
   * loading begins with r = 0. Where slip is a vector, these rates are those of
   * the size of tau by the component of slip along it; across it the joint is
   * elastic, by which tau turns, and unloads until it slips straight across
   * tau, with r that of the size there. A step that takes less than a share
   * 'rounding' off tau leaves r as it is: a joint that is held would get its
   * elastic stiffness back by the rounding of its slip. tau stays where the
   * pressure changes ks(s); what that changes of tau^2/(2 ks) is booked as
   * friction, either way. An open joint transfers nothing.
   */
  struct ContinuouslyYieldingLaw : RockLaw<ContinuouslyYieldingLaw>
  {
    static constexpr std::array<LawName, 1> names = {
      { { "continuously yielding",
          "rock joint with inelastic slip from the start of shearing" } }
    };

    PowerClosure closure;
    PowerStiffness stiffness;   /**< ks */
    double initial_angle  = 0.; /**< phi_m0 [rad] */
    double residual_angle = 0.; /**< phi [rad] */
    double roughness      = 0.; /**< R [m] */

    /** r is not above this [-]. */
    static constexpr double largest_reload = 0.75;
    /** Share of tau that is left to the rounding of slip [-]. */
    static constexpr double rounding = 1e-10;

    /** The law of a set of joints, or its entries of the parameter file. */
    static ContinuouslyYieldingLaw read(LawEntries &entries);

    /** Description of the law for --check. */
    std::string text() const;

    /** The law with the tangents of both angles divided by @p factor. */
    ContinuouslyYieldingLaw reduced(double factor) const;

    /** ks [Pa/m] at the traction s [Pa]. */
    double shear_stiffness(const double traction) const
    {
      return stiffness.at(traction);
    }
    double largest_shear_stiffness() const
    {
      return stiffness.at(stiffness.highest);
    }

    template <int dim>
    Slip<dim> slip_by_pressure(const RockPoint<dim> &point) const
    {
      const DualNumber<1> ks
          = stiffness.at(DualNumber<1>(-point.normal_traction, 0, -1.));
      return -point.shear_traction * (ks.by[0] / (ks.value * ks.value));
    }

    /** See find_step(). */
    template <int dim, typename Number>
    RockFlow<dim, Number> flow(const RockPoint<dim> &point,
                               const Number &closure,
                               const SlipOf<dim, Number> &slip) const;

    /** Sets @p point to tractions [Pa] at rest, at zero opening and slip: an
        offset of closure and slip. */
    template <int dim>
    void initialise(RockPoint<dim> &point, const double normal,
                    const Slip<dim> &shear) const
    {
      const double traction = std::max(0., -normal);
      point.normal_traction = -traction;
      point.shear_traction  = traction > 0. ? shear : Slip<dim>();
      point.plastic_opening = closure.closure(traction);
      point.plastic_slip    = -point.shear_traction / shear_stiffness(traction);
    }

    /** A point of another law has no phi_m: its |tau| falls to tau_m in the
        next step if it is above that. */
    template <int dim>
    void take_over(RockPoint<dim> &point) const
    {
      if (point.friction == 0.)
        point.friction = std::numeric_limits<double>::infinity();
    }

    /** phi_m [rad] after @p worn slip [m]. */
    template <typename Number>
    Number bounding_angle(const Number &worn) const
    {
      using std::exp;
      return residual_angle
             + (initial_angle - residual_angle) * exp(-(worn / roughness));
    }

    /** Whether the tractions of @p point are admissible; otherwise slip would
       lower them. */
    template <int dim>
    bool holds(const RockPoint<dim> &point) const
    {
      constexpr double margin = 1e-9;
      return magnitude(point.shear_traction)
             <= -(1. + margin) * point.normal_traction
                    * std::tan(bounding_angle(point.worn_slip));
    }

  private:
    /** flow() under a given strength: tractions and slips alone. */
    template <int dim, typename Number>
    RockFlow<dim, Number> load(const RockPoint<dim> &point,
                               const SlipOf<dim, Number> &before,
                               const Number &strength, const Number &ks,
                               const SlipOf<dim, Number> &slip) const;

    /** tau of @p point as it has fallen if the law became weaker after the
        last step, and the plastic slip of that, @p fallen [m]; see above. */
    template <int dim>
    Slip<dim> lowered(const RockPoint<dim> &point, double &fallen) const;

    /** The size that a shear traction of the size @p tau grows to, loaded by
        the elastic increment @p growth [Pa]. */
    template <typename Number>
    static Number loaded(Number tau, Number growth, const Number &strength,
                         const Number &reload);
  };

  template <typename Number>
  Number ContinuouslyYieldingLaw::loaded(Number tau, Number growth,
                                         const Number &strength,
                                         const Number &reload)
  {
    using std::exp;
    // Elastic as long as F would be above 1, and back by rounding.
    const Number stiff = reload * strength - tau;
    if (value_of(stiff) > value_of(growth) || value_of(growth) < 0.)
      return tau + growth;
    if (value_of(stiff) > 0.)
    {
      tau += stiff;
      growth -= stiff;
    }
    if (value_of(strength) > 0.)
      return strength
             - (strength - tau) * exp(-growth / (strength * (1. - reload)));
    return 0.;
  }

  template <int dim, typename Number>
  RockFlow<dim, Number>
  ContinuouslyYieldingLaw::load(const RockPoint<dim> &point,
                                const SlipOf<dim, Number> &before,
                                const Number &strength, const Number &ks,
                                const SlipOf<dim, Number> &slip) const
  {
    RockFlow<dim, Number> result;
    const Slip<dim> elastic
        = point.shear_traction / shear_stiffness(-point.normal_traction);
    const auto moved
        = slip - constant_slip<dim, Number>(point.plastic_slip + elastic);
    const SlipOf<dim, Number> trial = before + ks * moved;
    const Number size               = magnitude(trial);
    Number tau                      = magnitude(before);
    result.shear_traction           = trial;
    result.reload                   = point.reload;

    bool is_loaded = value_of(size) > 0.;
    if (value_of(before * moved)
        < -rounding * value_of(before * constant_slip<dim, Number>(elastic)))
    {
      is_loaded     = value_of(trial * moved) > 0.;
      tau           = is_loaded ? distance_of_line(before, moved) : size;
      result.reload = 0.;
      if (value_of(strength) > 0.)
        result.reload = tau / strength;
      if (value_of(result.reload) > largest_reload)
        result.reload = largest_reload;
    }
    if (is_loaded)
    {
      const Number growth   = size - tau;
      const Number reached  = loaded(tau, growth, strength, result.reload);
      result.shear_traction = reached * direction_of(trial);
      result.wear           = (size - reached) / ks;
      result.slips          = value_of(growth) > 0.
                     && value_of(size - reached) > 0.5 * value_of(growth);
    }
    result.plastic_slip = slip - result.shear_traction / ks;
    return result;
  }

  template <int dim>
  Slip<dim> ContinuouslyYieldingLaw::lowered(const RockPoint<dim> &point,
                                             double &fallen) const
  {
    constexpr unsigned int most_iterations = 60;
    constexpr double precision             = 1e-12;
    fallen                                 = 0.;
    const double traction                  = -point.normal_traction;
    const double size                      = magnitude(point.shear_traction);
    const auto friction
        = [&](const double after) { return std::tan(bounding_angle(after)); };
    if (size == 0. || traction <= 0.
        || !(friction(point.worn_slip) < (1. - precision) * point.friction))
      return point.shear_traction;
    const double ks = shear_stiffness(traction);
    // The fall itself wears the joint.
    double lower = size;
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      const double next
          = traction * friction(point.worn_slip + (size - lower) / ks);
      if (next >= (1. - precision) * lower)
        break;
      lower = next;
    }
    fallen = (size - lower) / ks;
    return lower / size * point.shear_traction;
  }

  template <int dim, typename Number>
  RockFlow<dim, Number>
  ContinuouslyYieldingLaw::flow(const RockPoint<dim> &point,
                                const Number &closure_now,
                                const SlipOf<dim, Number> &slip) const
  {
    using std::atan;
    using std::tan;
    const Number traction = closure.traction(closure_now);
    const Number ks       = stiffness.at(traction);

    const auto strength_at = [&](const Number &worn)
    { return Number(traction * tan(bounding_angle(worn))); };
    double fallen     = 0.;
    const auto before = constant_slip<dim, Number>(lowered<dim>(point, fallen));
    const Number worn = point.worn_slip + fallen;
    // By the wear in the middle of the step.
    const Number first  = load(point, before, strength_at(worn), ks, slip).wear;
    const Number middle = worn + 0.5 * first;
    auto result         = load(point, before, strength_at(middle), ks, slip);
    result.friction     = tan(bounding_angle(Number(worn + result.wear)));
    result.wear         = result.wear + fallen;
    result.slips        = result.slips || fallen > 0.;
    Number angle        = bounding_angle(middle);
    const Number tau    = magnitude(result.shear_traction);
    if (value_of(tau) >= value_of(traction) * std::tan(initial_angle))
    {
      if (value_of(traction) > 0.)
        angle = initial_angle;
    }
    else
      angle = atan(tau / traction);
    const Number dilation = tan(angle - residual_angle);
    if (value_of(dilation) > 0.)
      result.opening = dilation * result.wear;
    return result;
  }
} // namespace quoin

#endif
