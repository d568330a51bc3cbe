// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_coulomb_law_h
#define quoin_joint_laws_coulomb_law_h

#include <quoin/joint_laws/linear_springs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace quoin
{
  class LawEntries;

  /**
   * Strength of a joint: cohesion [Pa], friction coefficient tan(phi) and
   * tensile strength [Pa].
   */
  struct JointStrength
  {
    double cohesion = std::numeric_limits<double>::infinity();
    double friction = 0.;
    double tension  = std::numeric_limits<double>::infinity();

    /** Whether these tractions [Pa] are admissible; at the limit they are. */
    bool bears(const double normal, const double shear) const
    {
      const double margin = 1e-9 * (std::abs(normal) + std::abs(shear));
      return !(normal > tension + margin
               || std::abs(shear) + normal * friction > cohesion + margin);
    }
  };

  /**
   * The brittle Coulomb law with tension cut-off and dilation
   * (@cite ZhugeHunt2003, Eqs. 5-9).
   *
   * Its tractions are those of LinearSprings. An intact joint breaks when sigma
   * exceeds the tensile strength or |tau| exceeds c - sigma tan(phi); from
   * then on its strength is the residual one (by UDEC's rule zero cohesion
   * and tension unless given). While it slips, dw = +-tan(psi) |dp|, positive
   * when slip grows away from the origin and negative on the way back, as
   * long as |u_s| is below the critical shear displacement; where slip is a
   * vector, dw = tan(psi) times its component along u_s. An open joint
   * transfers no shear; it takes up shear afresh from where it closes.
   *
   * The elastic joint is this law with infinite strength, and the no-tension
   * joint (@cite JinWangZhang1998, Eq. 1) this law with zero tension and
   * residual strength equal to the peak; of their equation we drop the
   * cohesive shear of an open joint.
   */
  struct CoulombLaw : LinearSprings
  {
    template <int dim>
    using Point = JointPoint<dim>;

    static constexpr const char *kind = "a Coulomb, elastic or no-tension law";
    static constexpr std::array<LawName, 3> names = {
      { { "Coulomb",
          "cohesion, friction and tension that drop to their residual values "
          "at failure" },
        { "elastic", "linear springs that never fail" },
        { "no tension",
          "Coulomb without tension whose cohesion is never lost" } }
    };
    static constexpr bool is_brittle = true;
    static constexpr bool waits      = true;

    JointStrength peak;
    JointStrength residual;
    double dilation = 0.; /**< tan(psi) */
    double critical_shear_displacement
        = std::numeric_limits<double>::infinity(); /**< u_cs [m] */
    bool is_no_tension = false; /**< whether the law was named 'no tension' */

    /** The law of a set of joints, or its entries of the parameter file. */
    static CoulombLaw read(LawEntries &entries);

    /** Description of the law for --check. */
    std::string text() const;
    /** Warns of a tensile strength that no joint under shear reaches. */
    std::string warning() const;

    /** Strengths divided by @p factor, peak and residual; dilation is not
        above the friction that is left. */
    CoulombLaw reduced(double factor) const;

    JointBehaviour behaviour() const
    {
      const bool fails = std::isfinite(peak.tension);
      return { fails, dilation != 0.,
               peak.cohesion != residual.cohesion
                   || peak.friction != residual.friction
                   || peak.tension != residual.tension,
               fails && peak.cohesion > residual.cohesion };
    }
    template <int dim>
    bool lost_its_bond(const JointPoint<dim> &point) const
    {
      return behaviour().has_bond && point.state != JointState::intact
             && point.normal_traction < 0.
             && peak.bears(point.normal_traction,
                           magnitude(point.shear_traction));
    }
    std::string no_new_contacts() const
    {
      return behaviour().fails ? "" : "which would then hold together for good";
    }

    /**
     * Updates @p point for @p opening and @p slip [m] and returns
     * what that dissipated, by the trapezoidal rule of the explicit scheme.
     */
    template <int dim>
    JointDissipation update(JointPoint<dim> &point, const double opening,
                            const Slip<dim> &slip) const;

    /**
     * As update(), with the consistent tangent for a Newton solver, which
     * updates a copy of the point that it began with and keeps the last copy
     * once it has converged. Where a joint breaks its tractions jump; the
     * tangent is then that beyond the jump.
     */
    template <int dim>
    JointDissipation update(JointPoint<dim> &point, const double opening,
                            const Slip<dim> &slip,
                            JointTangent<dim> &tangent) const;

    /**
     * As update(), but what would make the tractions jump waits for @p loss,
     * as no Newton iteration survives it: an intact joint stays elastic beyond
     * its strength until its peak is lost; a closed one that opens keeps the
     * shear of its residual cohesion until that is lost, from when on it has
     * friction alone in this step, however often it opens and closes. One that
     * was open before the step has that from its start. See excess().
     */
    template <int dim>
    JointDissipation update_waiting(JointPoint<dim> &point,
                                    const double opening, const Slip<dim> &slip,
                                    const JointLoss loss,
                                    JointTangent<dim> &tangent) const;

    /** Excess of the stress of an intact @p point over its strength, as a
        fraction of its stress, or the shear of an open one by its cohesion;
        zero or less: it holds. */
    template <int dim>
    double excess(const JointPoint<dim> &point) const;

    /** As update(), if the joint neither fails, slips nor is open; else it
        returns false. */
    template <int dim>
    bool update_elastic(JointPoint<dim> &point, double opening,
                        const Slip<dim> &slip) const;

    /** As update(), for a joint that fails, slips or is open. */
    template <int dim>
    JointDissipation update_failing(JointPoint<dim> &point, double opening,
                                    const Slip<dim> &slip) const;

    /** Whether the stored energy of @p point changes with the opening, as that
        of open points under a residual tension does. */
    template <int dim>
    bool stores_by_opening(const JointPoint<dim> &point) const
    {
      return point.state == JointState::open && residual.tension > 0.;
    }

    /** Recoverable energy per area [J/m^2] of @p point at @p opening [m]. */
    template <int dim>
    double stored_energy(const JointPoint<dim> &point,
                         const double opening) const
    {
      const double normal
          = stores_by_opening(point)
                ? normal_energy(normal_stiffness
                                * (opening - point.plastic_opening))
                : 0.5 * point.normal_traction * point.normal_traction
                      / normal_stiffness;
      return normal
             + 0.5 * point.shear_traction * point.shear_traction
                   / shear_stiffness;
    }

    /** Whether the tractions of @p point, if it is intact, are admissible. */
    template <int dim>
    bool holds(const JointPoint<dim> &point) const
    {
      return peak.bears(point.normal_traction, magnitude(point.shear_traction));
    }

  private:
    /** As update(), for a joint without its peak that is open but keeps the
        shear which its residual cohesion bears. */
    template <int dim>
    JointDissipation hold_shear(JointPoint<dim> &point, const double opening,
                                const Slip<dim> &slip,
                                JointTangent<dim> &tangent) const;

    /** Driving quantities of the slip of a failed joint at its trial tractions.
     */
    template <int dim>
    struct Drive
    {
      Slip<dim> direction; /**< direction of tau */
      double psi;          /**< dw by |dp|, negative on the way back */
      double excess;       /**< excess of |tau| over the strength [Pa] */
      double stiffness;    /**< decrease of the excess per |dp| [Pa/m] */
    };
    /** Drive at trial tractions [Pa], from the slip @p before to that
       @p after the step [m]. */
    template <int dim>
    Drive<dim> drive(double sigma, const Slip<dim> &tau,
                     const Slip<dim> &before, const Slip<dim> &after) const;

    /** Slip [m] of @p point. */
    template <int dim>
    Slip<dim> slip_of(const JointPoint<dim> &point) const
    {
      return point.plastic_slip + point.shear_traction / shear_stiffness;
    }

    /** Derivative [Pa/m] of update_failing(), at the point as it was before. */
    template <int dim>
    JointTangent<dim> failing_tangent(const JointPoint<dim> &point,
                                      double opening,
                                      const Slip<dim> &slip) const;

    /** Energy per area [J/m^2] of the opening of a failed joint, whose traction
        is cut off at the residual strength. */
    double normal_energy(const double sigma_trial) const
    {
      const double cut = std::min(sigma_trial, residual.tension);
      return cut * (sigma_trial - 0.5 * cut) / normal_stiffness;
    }
  };

  template <int dim>
  inline bool CoulombLaw::update_elastic(JointPoint<dim> &point,
                                         const double opening,
                                         const Slip<dim> &slip) const
  {
    const bool intact             = point.state == JointState::intact;
    const JointStrength &strength = intact ? peak : residual;

    const double sigma  = normal_stiffness * (opening - point.plastic_opening);
    const Slip<dim> tau = shear_stiffness * (slip - point.plastic_slip);
    if (!(sigma <= strength.tension
          && magnitude(tau) <= std::max(0., strength.cohesion
                                                - sigma * strength.friction)))
      return false;
    point.normal_traction = sigma;
    point.shear_traction  = tau;
    if (!intact)
      point.state = JointState::slipped;
    return true;
  }

  template <int dim>
  inline JointDissipation CoulombLaw::update(JointPoint<dim> &point,
                                             const double opening,
                                             const Slip<dim> &slip) const
  {
    return update_elastic(point, opening, slip)
               ? JointDissipation()
               : update_failing(point, opening, slip);
  }

  template <int dim>
  inline CoulombLaw::Drive<dim>
  CoulombLaw::drive(const double sigma, const Slip<dim> &tau,
                    const Slip<dim> &before, const Slip<dim> &after) const
  {
    Drive<dim> result;
    result.direction = direction_of(tau);
    result.psi       = magnitude(after) < critical_shear_displacement
                           ? dilation * growth(result.direction, before, after)
                           : 0.;
    result.excess
        = magnitude(tau) - residual.cohesion + sigma * residual.friction;
    const double stiffness
        = shear_stiffness + normal_stiffness * result.psi * residual.friction;
    result.stiffness
        = stiffness > 0.1 * shear_stiffness ? stiffness : shear_stiffness;
    return result;
  }

  template <int dim>
  inline JointDissipation
  CoulombLaw::update_failing(JointPoint<dim> &point, const double opening,
                             const Slip<dim> &slip) const
  {
    const double kn = normal_stiffness, ks = shear_stiffness;
    const double sigma_old  = point.normal_traction;
    const Slip<dim> tau_old = point.shear_traction;
    const bool intact       = point.state == JointState::intact;

    const double sigma_trial  = kn * (opening - point.plastic_opening);
    const Slip<dim> tau_trial = ks * (slip - point.plastic_slip);

    JointDissipation dissipation;
    if (sigma_trial > residual.tension)
    {
      const double sigma = std::min(sigma_trial, residual.tension);
      // Work less the change of stored energy. A joint that opens without
      // having been intact dissipates nothing here: what the finite step
      // makes of the kink in its law is left to the energy residual.
      if (intact)
        dissipation.fracture
            = 0.5 * (sigma_old + sigma) * (sigma_trial - sigma_old) / kn
              + 0.5 * sigma_old * sigma_old / kn - normal_energy(sigma_trial);
      const double shear_loss = 0.5 * tau_old * (slip - point.plastic_slip);
      (intact ? dissipation.fracture : dissipation.friction) += shear_loss;

      point.normal_traction = sigma;
      point.shear_traction  = Slip<dim>();
      point.plastic_slip    = slip;
      point.state           = JointState::open;
      return dissipation;
    }

    // Slip: implicit in sigma, because dilation presses the joint together.
    const auto [direction, psi, excess, stiffness]
        = drive<dim>(sigma_trial, tau_trial, slip_of(point), slip);
    double dp = std::max(0., excess) / stiffness;
    // Friction cannot turn the shear traction round.
    dp = std::min(dp, magnitude(tau_trial) / ks);

    const double sigma  = sigma_trial - kn * psi * dp;
    const Slip<dim> tau = tau_trial - direction * ks * dp;
    dissipation.friction
        = 0.5 * ((tau_old + tau) * direction + (sigma_old + sigma) * psi) * dp;

    point.normal_traction = sigma;
    point.shear_traction  = tau;
    point.plastic_slip += direction * dp;
    point.plastic_opening += psi * dp;
    point.state = JointState::slipping;
    return dissipation;
  }

  template <int dim>
  inline JointDissipation
  CoulombLaw::update(JointPoint<dim> &point, const double opening,
                     const Slip<dim> &slip, JointTangent<dim> &tangent) const
  {
    const JointPoint<dim> before = point;
    if (update_elastic(point, opening, slip))
    {
      tangent = { normal_stiffness, {}, {}, isotropic<dim>(shear_stiffness) };
      return {};
    }
    tangent = failing_tangent(before, opening, slip);
    return update_failing(point, opening, slip);
  }

  template <int dim>
  inline JointDissipation
  CoulombLaw::hold_shear(JointPoint<dim> &point, const double opening,
                         const Slip<dim> &slip,
                         JointTangent<dim> &tangent) const
  {
    const double kn = normal_stiffness, ks = shear_stiffness;
    const double sigma_old    = point.normal_traction;
    const Slip<dim> tau_old   = point.shear_traction;
    const double sigma_trial  = kn * (opening - point.plastic_opening);
    const Slip<dim> tau_trial = ks * (slip - point.plastic_slip);
    const double sigma        = residual.tension;
    const double strength
        = std::max(0., residual.cohesion - sigma * residual.friction);
    const Slip<dim> direction = direction_of(tau_trial);
    const double size         = magnitude(tau_trial);
    const double borne        = std::min(size, strength);
    const double dp           = (size - borne) / ks;

    tangent = { 0., {}, {}, isotropic<dim>(ks) };
    if (size > strength) // where slip turns, so does what it bears
      tangent.shear_slip
          = ks * borne / size
            * (isotropic<dim>(1.) - outer_product(direction, direction));

    JointDissipation dissipation;
    if (point.state == JointState::intact)
      dissipation.fracture
          = 0.5 * (sigma_old + sigma) * (sigma_trial - sigma_old) / kn
            + 0.5 * sigma_old * sigma_old / kn - normal_energy(sigma_trial);
    dissipation.friction = 0.5 * (tau_old * direction + borne) * dp;

    point.normal_traction = sigma;
    point.shear_traction  = borne * direction;
    point.plastic_slip += dp * direction;
    point.state = JointState::open;
    return dissipation;
  }

  template <int dim>
  inline JointDissipation
  CoulombLaw::update_waiting(JointPoint<dim> &point, const double opening,
                             const Slip<dim> &slip, const JointLoss loss,
                             JointTangent<dim> &tangent) const
  {
    const bool intact = point.state == JointState::intact;
    CoulombLaw law    = *this;
    if (intact && loss == JointLoss::nothing)
    {
      law.peak = JointStrength(); // no strength limits it
      return law.update(point, opening, slip, tangent);
    }
    if (behaviour().fails && residual.cohesion > 0.)
    {
      if (loss == JointLoss::cohesion || point.state == JointState::open)
        law.residual.cohesion = 0.;
      else if (normal_stiffness * (opening - point.plastic_opening)
               > residual.tension)
        return hold_shear(point, opening, slip, tangent);
    }
    if (intact)
      law.peak = law.residual; // from now on
    return law.update(point, opening, slip, tangent);
  }

  template <int dim>
  inline double CoulombLaw::excess(const JointPoint<dim> &point) const
  {
    if (!behaviour().fails)
      return 0.;
    const double tau = magnitude(point.shear_traction);
    if (point.state == JointState::open)
      return tau > 0. ? tau / residual.cohesion : 0.;
    if (point.state != JointState::intact)
      return 0.;
    const double sigma = point.normal_traction;
    const double shear = tau + sigma * peak.friction - peak.cohesion;
    const double size  = std::max(std::abs(sigma), tau);
    return size > 0. ? std::max(sigma - peak.tension, shear) / size : 0.;
  }

  template <int dim>
  inline JointTangent<dim>
  CoulombLaw::failing_tangent(const JointPoint<dim> &point,
                              const double opening, const Slip<dim> &slip) const
  {
    const double kn = normal_stiffness, ks = shear_stiffness;
    const double sigma_trial  = kn * (opening - point.plastic_opening);
    const Slip<dim> tau_trial = ks * (slip - point.plastic_slip);
    if (sigma_trial > residual.tension)
      return {}; // open: the residual tension, no shear

    const auto [direction, psi, excess, stiffness]
        = drive<dim>(sigma_trial, tau_trial, slip_of(point), slip);
    if (excess <= 0.) // the residual strength is above the peak's
      return { kn, {}, {}, isotropic<dim>(ks) };

    // Derivatives of the plastic slip dp by opening and slip; at the bound all
    // of the slip is plastic.
    const double largest  = magnitude(tau_trial) / ks;
    const bool is_bounded = excess / stiffness > largest;
    const double by_opening
        = is_bounded ? 0. : kn * residual.friction / stiffness;
    Slip<dim> by_slip = direction * (is_bounded ? 1. : ks / stiffness);
    // Where slip turns, so do its direction and the share that dilates.
    const double dp        = is_bounded ? largest : excess / stiffness;
    const double turn      = largest > 0. ? dp / largest : 1.;
    const Slip<dim> before = slip_of(point);
    const double size      = magnitude(before) + magnitude(slip);
    Slip<dim> psi_by_slip{};
    if (size > 0. && largest > 0.
        && magnitude(slip) < critical_shear_displacement)
    {
      const Slip<dim> along = (before + slip) / size;
      const double c        = direction * along;
      psi_by_slip           = dilation
                    * ((along - c * direction) / largest
                       + (direction - c * direction_of(slip)) / size);
    }
    if (!is_bounded && stiffness != ks)
      by_slip -= dp / stiffness * kn * residual.friction * psi_by_slip;
    JointTangent<dim> tangent;
    tangent.normal_slip = -kn * dp * psi_by_slip;
    tangent.shear_slip
        = -ks * turn
          * (isotropic<dim>(1.) - outer_product(direction, direction));
    tangent.normal_opening = kn - kn * psi * by_opening;
    tangent.normal_slip += -kn * psi * by_slip;
    tangent.shear_opening = -direction * ks * by_opening;
    tangent.shear_slip
        += isotropic<dim>(ks) - ks * outer_product(direction, by_slip);
    return tangent;
  }
} // namespace quoin

#endif
