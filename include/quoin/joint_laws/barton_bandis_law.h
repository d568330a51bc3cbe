// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_barton_bandis_law_h
#define quoin_joint_laws_barton_bandis_law_h

#include <quoin/base/constants.h>
#include <quoin/joint_laws/rock_point.h>

#include <string>

namespace quoin
{
  /**
   * The closure of a joint of rock under pressure, @cite Bandis1983: with the
   * first stiffness kni [Pa/m] and the largest closure Vm [m],
   *
   *     s = kni V / (1 - V/Vm),
   *
   * the same curve loading and unloading. Beyond the closure where its slope
   * has reached a largest stiffness it continues linearly with that, so that
   * there is a stable time step.
   */
  class HyperbolicClosure
  {
  public:
    /** Stiffnesses [Pa/m], @p largest not below @p first; Vm [m]. */
    HyperbolicClosure(double first, double largest_closure, double largest);

    /** s [Pa] at the closure V [m]; none if that is negative. Its derivative
        at zero is that of closing. */
    template <typename Number>
    Number traction(const Number &closure) const
    {
      if (value_of(closure) < 0.)
        return 0.;
      if (value_of(closure) >= end_closure)
        return end_traction + largest * (closure - end_closure);
      return first * closure / (1. - closure / limit);
    }

    /** V [m] at s [Pa]. */
    double closure(double traction) const;

    /** ds/dV [Pa/m] at s [Pa]. */
    double stiffness(double traction) const;

    /** Recoverable energy per area [J/m^2] at s [Pa]. */
    double energy(double traction) const;

    double largest_stiffness() const
    {
      return largest;
    }

  private:
    template <typename Law, int lanes, int dim>
    friend class LawLanes;

    double first, limit, largest; /**< kni [Pa/m], Vm [m], [Pa/m] */
    /** Closure and traction where the linear part begins [m], [Pa]. */
    double end_closure, end_traction;
  };

  /** Mobilised roughness by slip of @cite BartonBandisBakhtar1985. */
  struct RoughnessTable
  {
    static constexpr unsigned int size = 8;
    /** Slip by peak slip [-]. */
    static constexpr double slip[size]
        = { 0.3, 0.6, 1., 2., 4., 10., 25., 100. };
    /** Mobilised roughness by JRC [-]. */
    static constexpr double share[size]
        = { 0., 0.75, 1., 0.85, 0.7, 0.5, 0.4, 0. };
  };

  /**
   * The joint of Barton and Bandis: closure by a hyperbola, no tension, and the
   * shear strength of @cite BartonChoubey1977,
   *
   *     |tau| <= s tan(phi_r + i m),  i = JRC log10(JCS/s),
   *
   * with the mobilisation m of @cite BartonBandisBakhtar1985, straight between
   * the rows of RoughnessTable; up to 0.3 of the peak slip the angle grows
   * straight from 0 to phi_r. phi_r + i is at most 70 degrees, i at least 0.
   * What counts as slip is the inelastic slip in both senses so far and the
   * elastic slip of the moment: on the way to the peak the total slip, as
   * published. ks should be some times the peak strength over the peak slip.
   *
   * Below the strength tau = ks (u_s - p). Slip away from the origin dilates by
   * the angle i m/2; slip back closes the joint by that angle until it has
   * taken back what it had dilated. Where slip is a vector, it goes along tau,
   * and its component along u_s is what dilates or closes, so that slip round
   * the origin does neither. An open joint transfers nothing.
   */
  struct BartonBandisLaw : RockLaw<BartonBandisLaw>
  {
    static constexpr std::array<LawName, 1> names
        = { { { "Barton-Bandis",
                "rock joint with hyperbolic closure and a roughness that is "
                "mobilised and worn by slip" } } };

    HyperbolicClosure closure;
    double stiffness      = 0.; /**< ks [Pa/m] */
    double residual_angle = 0.; /**< phi_r [rad] */
    double roughness      = 0.; /**< JRC, as an angle [rad] */
    double wall_strength  = 0.; /**< JCS [Pa] */
    double peak_slip      = 0.; /**< [m] */
    double divisor        = 1.; /**< divisor of the shear strength [-] */

    /** phi_r + i of the peak is not above this [rad]. */
    static constexpr double largest_angle = 70. * constants::degree;

    /** The law of a set of joints, or its entries of the parameter file. */
    static BartonBandisLaw read(LawEntries &entries);

    /** Description of the law for --check. */
    std::string text() const;

    /** The law with the shear strength divided by @p factor. */
    BartonBandisLaw reduced(double factor) const;

    /** ks [Pa/m]. */
    double shear_stiffness(const double /*traction*/ = 0.) const
    {
      return stiffness;
    }
    double largest_shear_stiffness() const
    {
      return stiffness;
    }

    double slip_of_peak() const
    {
      return peak_slip;
    }

    /** Dilation angle i [rad] by peak roughness at the traction s [Pa]. */
    template <typename Number>
    Number peak_roughness(const Number &traction) const;

    /** m [-] and the share of phi_r [-], at the slip by the peak slip. */
    template <typename Number>
    static void mobilise(const Number &slip, Number &roughness, Number &basic);

    /** Shear strength [Pa] and tan of the dilation angle [-] at the traction
        s [Pa] and the slip [m]. */
    template <typename Number>
    Number strength(const Number &traction, const Number &slip,
                    Number &dilation) const;

    /** See find_step(). */
    template <int dim, typename Number>
    RockFlow<dim, Number> flow(const RockPoint<dim> &point,
                               const Number &closure,
                               const SlipOf<dim, Number> &slip) const;

    /**
     * Sets @p point to tractions [Pa] at rest, at zero opening and slip,
     * mobilised as far as these need: an offset of closure and slip.
     */
    template <int dim>
    void initialise(RockPoint<dim> &point, double normal,
                    const Slip<dim> &shear) const;

    /** Whether @p point, at zero opening and slip, has admissible tractions; at
        rest they would come down to what it does bear if not. */
    template <int dim>
    bool holds(RockPoint<dim> point) const
    {
      constexpr double margin = 1e-6; // of what an iteration finds
      const double sigma      = point.normal_traction;
      const Slip<dim> tau     = point.shear_traction;
      update(point, 0., Slip<dim>());
      return std::abs(point.normal_traction - sigma)
                 + magnitude(point.shear_traction - tau)
             <= margin * (std::abs(sigma) + magnitude(tau));
    }

  private:
    /** The slip [m] that mobilises the shear traction of the size @p tau under
        the pressure @p traction [Pa], on the way to the peak. */
    double mobilising_slip(double tau, double traction) const;
  };

  template <typename Number>
  Number BartonBandisLaw::peak_roughness(const Number &traction) const
  {
    const double by_e = roughness / std::log(10.);
    const double cap  = largest_angle - residual_angle;
    const double angle
        = by_e * std::log(wall_strength / value_of(traction)); // or infinite
    if (!(angle > 0.))
      return 0.;
    if (!(angle < cap))
      return cap;
    using std::log;
    return by_e * log(wall_strength / traction);
  }

  template <typename Number>
  void BartonBandisLaw::mobilise(const Number &slip, Number &roughness,
                                 Number &basic)
  {
    using Table    = RoughnessTable;
    const double x = value_of(slip);
    roughness      = 0.;
    basic          = 1.;
    if (x < Table::slip[0])
      basic = slip / Table::slip[0];
    for (unsigned int i = 0; i + 1 < Table::size; ++i)
      if (x >= Table::slip[i] && x < Table::slip[i + 1])
        roughness = Table::share[i]
                    + (slip - Table::slip[i])
                          * ((Table::share[i + 1] - Table::share[i])
                             / (Table::slip[i + 1] - Table::slip[i]));
  }

  template <typename Number>
  Number BartonBandisLaw::strength(const Number &traction, const Number &slip,
                                   Number &dilation) const
  {
    using std::tan;
    Number mobilised, basic;
    mobilise(slip / peak_slip, mobilised, basic);
    const Number angle    = peak_roughness(traction) * mobilised;
    const Number friction = tan(residual_angle * basic + angle) / divisor;
    dilation              = tan(0.5 * angle);
    // A reduced strength dilates no more than slip can pay for.
    if (value_of(dilation) > value_of(friction))
      dilation = friction;
    return traction * friction;
  }

  template <int dim, typename Number>
  RockFlow<dim, Number>
  BartonBandisLaw::flow(const RockPoint<dim> &point, const Number &closure_now,
                        const SlipOf<dim, Number> &slip) const
  {
    RockFlow<dim, Number> result;
    result.plastic_slip   = constant_slip<dim, Number>(point.plastic_slip);
    result.shear_traction = Number(stiffness) * (slip - result.plastic_slip);
    const SlipOf<dim, Number> trial = result.shear_traction;
    const Number size               = magnitude(trial);
    Number dilation;
    const Number limit = strength(closure.traction(closure_now),
                                  point.worn_slip + size / stiffness, dilation);
    if (value_of(size) <= value_of(limit))
      return result;

    const auto direction = direction_of(trial);
    const Slip<dim> before
        = point.plastic_slip + point.shear_traction / stiffness;
    const auto away
        = growth(direction, constant_slip<dim, Number>(before), slip);
    result.slips          = true;
    result.wear           = (size - limit) / stiffness;
    result.shear_traction = limit * direction;
    result.plastic_slip   = result.plastic_slip + result.wear * direction;
    result.opening        = away * dilation * result.wear;
    if (value_of(away) >= 0.)
      return result;
    // Back down: no farther than it came up, nor than it is closed.
    Number back = -result.opening;
    if (value_of(back) > point.dilated)
      back = point.dilated;
    if (value_of(back) > value_of(closure_now))
      back = closure_now;
    result.opening = -back;
    return result;
  }

  template <int dim>
  void BartonBandisLaw::initialise(RockPoint<dim> &point, const double normal,
                                   const Slip<dim> &shear) const
  {
    const double traction = std::max(0., -normal);
    const Slip<dim> tau   = traction > 0. ? shear : Slip<dim>();
    const double size     = magnitude(tau);
    point.normal_traction = -traction;
    point.shear_traction  = tau;
    point.plastic_opening = closure.closure(traction);
    point.plastic_slip    = -tau / stiffness;
    point.worn_slip       = 0.;
    if (size > 0.)
      point.worn_slip
          = std::max(0., mobilising_slip(size, traction) - size / stiffness);
  }
} // namespace quoin

#endif
