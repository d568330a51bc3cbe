// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_coulomb_law_h
#define quoin_joints_coulomb_law_h

#include <quoin/base/state.h>
#include <quoin/joints/joint_tangent.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  /**
   * Strength of a joint: cohesion [Pa], friction coefficient tan(phi) and
   * tensile strength [Pa].
   */
  struct JointStrength
  {
    double cohesion = std::numeric_limits<double>::infinity();
    double friction = 0.;
    double tension  = std::numeric_limits<double>::infinity();

    /** Whether it bears these tractions [Pa]; at the limit it does. */
    bool bears(const double normal, const double shear) const
    {
      const double margin = 1e-9 * (std::abs(normal) + std::abs(shear));
      return !(normal > tension + margin
               || std::abs(shear) + normal * friction > cohesion + margin);
    }
  };

  /** One joint point: what the law reads and overwrites. */
  struct JointPoint
  {
    double normal_traction = 0.; /**< sigma [Pa], tension positive */
    double shear_traction  = 0.; /**< tau [Pa] */
    double plastic_slip    = 0.; /**< [m] */
    double plastic_opening = 0.; /**< [m] */
    JointState state       = JointState::intact;
  };

  /** Energy per area that an update dissipated [J/m^2]. */
  struct JointDissipation
  {
    double friction = 0.;
    double fracture = 0.;
  };

  /**
   * The brittle Coulomb law with tension cut-off and dilation
   * (@cite ZhugeHunt2003, Eqs. 5-9).
   *
   * sigma = kn (u_n - w), tau = ks (u_s - p) with opening u_n, slip u_s,
   * plastic opening w and plastic slip p. An intact joint breaks when sigma
   * exceeds the tensile strength or |tau| exceeds c - sigma tan(phi); from
   * then on its strength is the residual one (by UDEC's rule zero cohesion
   * and tension unless given). While it slips, dw = +-tan(psi) |dp|, positive
   * when slip grows away from the origin and negative on the way back, as
   * long as |u_s| is below the critical shear displacement. An open joint
   * transfers no shear; it takes up shear afresh from where it closes.
   *
   * The elastic joint is this law with infinite strength, and the no-tension
   * joint (@cite JinWangZhang1998, Eq. 1) this law with zero tension and
   * residual strength equal to the peak; of their equation we drop the
   * cohesive shear of an open joint.
   */
  struct CoulombLaw
  {
    using Point = JointPoint;

    double normal_stiffness = 0.; /**< kn [Pa/m] */
    double shear_stiffness  = 0.; /**< ks [Pa/m] */
    JointStrength peak;
    JointStrength residual;
    double dilation = 0.; /**< tan(psi) */
    double critical_shear_displacement
        = std::numeric_limits<double>::infinity(); /**< u_cs [m] */

    /**
     * Brings @p point to the given @p opening and @p slip [m] and returns
     * what that dissipated, by the trapezoidal rule of the explicit scheme.
     */
    JointDissipation update(JointPoint &point, const double opening,
                            const double slip) const;

    /**
     * The same with the consistent tangent, for a Newton solver, which
     * updates a copy of the point that it began with and keeps the last copy
     * once it has converged. Where a joint breaks its tractions jump; the
     * tangent is then that beyond the jump.
     */
    JointDissipation update(JointPoint &point, const double opening,
                            const double slip, JointTangent &tangent) const;

    /** The same, if the joint neither fails, slips nor is open; else false. */
    bool update_elastic(JointPoint &point, double opening, double slip) const;

    /** The same for a joint that fails, slips or is open. */
    JointDissipation update_failing(JointPoint &point, double opening,
                                    double slip) const;

    /** Recoverable energy per area [J/m^2] of @p point at @p opening [m]. */
    double stored_energy(const JointPoint &point, const double opening) const
    {
      const double normal
          = point.state == JointState::open
                ? normal_energy(normal_stiffness
                                * (opening - point.plastic_opening))
                : 0.5 * point.normal_traction * point.normal_traction
                      / normal_stiffness;
      return normal
             + 0.5 * point.shear_traction * point.shear_traction
                   / shear_stiffness;
    }

    /** Whether @p point bears its tractions, if it is intact. */
    bool holds(const JointPoint &point) const
    {
      return peak.bears(point.normal_traction, point.shear_traction);
    }

  private:
    /** What drives a failed joint to slip beyond its trial tractions. */
    struct Slip
    {
      double direction; /**< of tau, 1 or -1 */
      double psi;       /**< dw by |dp|, negative on the way back */
      double excess;    /**< of |tau| above the strength [Pa] */
      double stiffness; /**< by which |dp| lowers it [Pa/m] */
    };
    /** At trial tractions [Pa] and the @p slip [m]. */
    Slip trial_slip(double sigma, double tau, double slip) const;

    /** Derivative [Pa/m] of update_failing(), at the point as it was before. */
    JointTangent failing_tangent(const JointPoint &point, double opening,
                                 double slip) const;

    /** Of a failed joint, whose traction is cut off at the residual one. */
    double normal_energy(const double sigma_trial) const
    {
      const double cut = std::min(sigma_trial, residual.tension);
      return cut * (sigma_trial - 0.5 * cut) / normal_stiffness;
    }
  };

  inline bool CoulombLaw::update_elastic(JointPoint &point,
                                         const double opening,
                                         const double slip) const
  {
    const bool intact             = point.state == JointState::intact;
    const JointStrength &strength = intact ? peak : residual;

    const double sigma = normal_stiffness * (opening - point.plastic_opening);
    const double tau   = shear_stiffness * (slip - point.plastic_slip);
    if (!(sigma <= strength.tension
          && std::abs(tau) <= std::max(0., strength.cohesion
                                               - sigma * strength.friction)))
      return false;
    point.normal_traction = sigma;
    point.shear_traction  = tau;
    if (!intact)
      point.state = JointState::slipped;
    return true;
  }

  inline JointDissipation CoulombLaw::update(JointPoint &point,
                                             const double opening,
                                             const double slip) const
  {
    return update_elastic(point, opening, slip)
               ? JointDissipation()
               : update_failing(point, opening, slip);
  }

  inline CoulombLaw::Slip CoulombLaw::trial_slip(const double sigma,
                                                 const double tau,
                                                 const double slip) const
  {
    Slip result;
    result.direction = tau < 0. ? -1. : 1.;
    result.psi       = std::abs(slip) < critical_shear_displacement
                           ? (result.direction * slip >= 0. ? dilation : -dilation)
                           : 0.;
    result.excess
        = std::abs(tau) - residual.cohesion + sigma * residual.friction;
    const double stiffness
        = shear_stiffness + normal_stiffness * result.psi * residual.friction;
    result.stiffness
        = stiffness > 0.1 * shear_stiffness ? stiffness : shear_stiffness;
    return result;
  }

  inline JointDissipation CoulombLaw::update_failing(JointPoint &point,
                                                     const double opening,
                                                     const double slip) const
  {
    const double kn = normal_stiffness, ks = shear_stiffness;
    const double sigma_old = point.normal_traction;
    const double tau_old   = point.shear_traction;
    const bool intact      = point.state == JointState::intact;

    const double sigma_trial = kn * (opening - point.plastic_opening);
    const double tau_trial   = ks * (slip - point.plastic_slip);

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
      point.shear_traction  = 0.;
      point.plastic_slip    = slip;
      point.state           = JointState::open;
      return dissipation;
    }

    // Slip: implicit in sigma, because dilation presses the joint together.
    const auto [direction, psi, excess, stiffness]
        = trial_slip(sigma_trial, tau_trial, slip);
    double dp = std::max(0., excess) / stiffness;
    // Friction cannot turn the shear traction round.
    dp = std::min(dp, std::abs(tau_trial) / ks);

    const double sigma = sigma_trial - kn * psi * dp;
    const double tau   = tau_trial - direction * ks * dp;
    dissipation.friction
        = 0.5 * ((tau_old + tau) * direction + (sigma_old + sigma) * psi) * dp;

    point.normal_traction = sigma;
    point.shear_traction  = tau;
    point.plastic_slip += direction * dp;
    point.plastic_opening += psi * dp;
    point.state = JointState::slipping;
    return dissipation;
  }

  inline JointDissipation CoulombLaw::update(JointPoint &point,
                                             const double opening,
                                             const double slip,
                                             JointTangent &tangent) const
  {
    const JointPoint before = point;
    if (update_elastic(point, opening, slip))
    {
      tangent = { normal_stiffness, 0., 0., shear_stiffness };
      return {};
    }
    tangent = failing_tangent(before, opening, slip);
    return update_failing(point, opening, slip);
  }

  inline JointTangent CoulombLaw::failing_tangent(const JointPoint &point,
                                                  const double opening,
                                                  const double slip) const
  {
    const double kn = normal_stiffness, ks = shear_stiffness;
    const double sigma_trial = kn * (opening - point.plastic_opening);
    const double tau_trial   = ks * (slip - point.plastic_slip);
    if (sigma_trial > residual.tension)
      return {}; // open: the residual tension, no shear

    const auto [direction, psi, excess, stiffness]
        = trial_slip(sigma_trial, tau_trial, slip);
    if (excess <= 0.) // the residual strength is above the peak's
      return { kn, 0., 0., ks };

    // Of the plastic slip dp by opening and slip; all of it at the bound.
    const bool is_bounded = excess / stiffness > std::abs(tau_trial) / ks;
    const double by_opening
        = is_bounded ? 0. : kn * residual.friction / stiffness;
    const double by_slip = direction * (is_bounded ? 1. : ks / stiffness);
    return { kn - kn * psi * by_opening, -kn * psi * by_slip,
             -direction * ks * by_opening, ks - direction * ks * by_slip };
  }
} // namespace quoin

#endif
