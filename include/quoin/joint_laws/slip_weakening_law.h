// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_slip_weakening_law_h
#define quoin_joint_laws_slip_weakening_law_h

#include <quoin/joint_laws/linear_springs.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace quoin
{
  class LawEntries;

  /** One point of a joint that slip weakens. */
  template <int dim>
  struct SlipWeakeningPoint : JointPoint<dim>
  {
    double slipped = 0.; /**< sum of |dp|, D [m] */

    static constexpr std::array<double SlipWeakeningPoint::*, 1> internal
        = { &SlipWeakeningPoint::slipped };
  };

  /**
   * Friction and cohesion that fall in proportion to slip, the law of faults
   * in which a rupture runs (@cite Ida1972, @cite Andrews1976):
   *
   *     sigma = kn (u_n - w) <= 0, tau = ks (u_s - p),
   *     |tau| <= c - sigma mu,
   *     c  = c_r  + (c_0  - c_r)  max(0, 1 - D/D_c),  mu likewise,
   *
   * D being the sum of |dp| in any direction, which never heals. No tension,
   * no dilation. An open joint transfers nothing; it takes up shear afresh
   * from where it closes. Over the weakening slip D_c a joint under the
   * constant traction sigma dissipates (c_0 - c_r - sigma (mu_0 - mu_r))
   * D_c/2 beside what its residual strength does: the fracture energy.
   *
   * Unless ks D_c is above what the strength loses the joint drops by itself
   * at failure, however small the step.
   */
  struct SlipWeakeningLaw : LinearSprings
  {
    template <int dim>
    using Point = SlipWeakeningPoint<dim>;

    static constexpr const char *kind = "a slip-weakening law";
    static constexpr std::array<LawName, 1> names
        = { { { "slip weakening",
                "cohesion and friction that decrease linearly with slip, "
                "without tension, for faults" } } };
    static constexpr bool waits = true;

    double cohesion          = 0.; /**< c_0 [Pa] */
    double residual_cohesion = 0.; /**< c_r [Pa] */
    double friction          = 0.; /**< mu_0 = tan(phi) [-] */
    double residual_friction = 0.; /**< mu_r [-] */
    double weakening_slip    = 0.; /**< D_c [m] */

    /** The law of a set of joints, or its entries of the parameter file. */
    static SlipWeakeningLaw read(LawEntries &entries);

    /** Description of the law for --check. */
    std::string text() const;

    /** The law with cohesions and friction coefficients divided by @p factor.
     */
    SlipWeakeningLaw reduced(double factor) const;

    /** Warning about a strength that drops abruptly without pressure. */
    std::string warning() const;

    JointBehaviour behaviour() const
    {
      JointBehaviour result;
      result.dilates = false;
      return result;
    }

    /** Strength [Pa] after the slip D = @p slipped [m] at @p sigma [Pa]. */
    double strength(const double sigma, const double slipped) const
    {
      const double left = std::max(0., 1. - slipped / weakening_slip);
      return residual_strength(sigma) + left * loss(sigma);
    }

    /** Sets @p point to tractions [Pa] at rest, at zero opening and slip. */
    template <int dim>
    void initialise(SlipWeakeningPoint<dim> &point, const double normal,
                    const Slip<dim> &shear) const
    {
      LinearSprings::initialise(point, std::min(normal, 0.),
                                normal < 0. ? shear : Slip<dim>());
    }

    /** Whether the tractions of @p point are admissible. */
    template <int dim>
    bool holds(const SlipWeakeningPoint<dim> &point) const
    {
      const double tau    = magnitude(point.shear_traction);
      const double sigma  = point.normal_traction;
      const double margin = 1e-9 * (tau - sigma);
      return tau <= strength(sigma, point.slipped) + margin;
    }

    /** New contacts have slipped by more than D_c. */
    template <int dim>
    void wear_out(SlipWeakeningPoint<dim> &point) const
    {
      point.slipped = std::numeric_limits<double>::infinity();
    }

    /** Updates @p point for @p opening and @p slip [m] if it neither slips nor
       is open there; otherwise returns false. */
    template <int dim>
    bool update_elastic(SlipWeakeningPoint<dim> &point, const double opening,
                        const Slip<dim> &slip) const
    {
      const double sigma = normal_stiffness * (opening - point.plastic_opening);
      const Slip<dim> tau = shear_stiffness * (slip - point.plastic_slip);
      if (!(sigma <= 0. && magnitude(tau) <= strength(sigma, point.slipped)))
        return false;
      point.normal_traction = sigma;
      point.shear_traction  = tau;
      if (point.state != JointState::intact)
        point.state = JointState::slipped;
      return true;
    }

    /** As update(), for a joint that slips or is open; returns what that
        dissipated, by the trapezoidal rule. */
    template <int dim>
    JointDissipation update_failing(SlipWeakeningPoint<dim> &point,
                                    const double opening,
                                    const Slip<dim> &slip) const;

    /** Both with the consistent tangent, see CoulombLaw. */
    template <int dim>
    JointDissipation update(SlipWeakeningPoint<dim> &point,
                            const double opening, const Slip<dim> &slip,
                            JointTangent<dim> &tangent) const;

    /** As update(), but a closed joint that opens keeps the shear which its
        cohesion bears until its @p loss, see CoulombLaw. */
    template <int dim>
    JointDissipation update_waiting(SlipWeakeningPoint<dim> &point,
                                    const double opening, const Slip<dim> &slip,
                                    const JointLoss loss,
                                    JointTangent<dim> &tangent) const;

    /** Shear of an open @p point by the cohesion, zero: it holds. */
    template <int dim>
    double excess(const SlipWeakeningPoint<dim> &point) const
    {
      const double tau = magnitude(point.shear_traction);
      return point.state == JointState::open && tau > 0.
                 ? tau / std::max(cohesion, residual_cohesion)
                 : 0.;
    }

    template <int dim>
    JointDissipation update(SlipWeakeningPoint<dim> &point,
                            const double opening, const Slip<dim> &slip) const
    {
      return update_elastic(point, opening, slip)
                 ? JointDissipation()
                 : update_failing(point, opening, slip);
    }

  private:
    /** Residual strength at the normal traction @p sigma [Pa]. */
    double residual_strength(const double sigma) const
    {
      return residual_cohesion - sigma * residual_friction;
    }
    /** Loss of strength over D_c [Pa]. */
    double loss(const double sigma) const
    {
      return cohesion - residual_cohesion
             - sigma * (friction - residual_friction);
    }

    /** Increment of slip [m] that takes a trial traction of the size @p tau
        [Pa] to the strength, and by how much the strength falls with it
        [Pa/m]. */
    struct Step
    {
      double slip, weakening;
    };
    Step find_slip(const double sigma, const double tau,
                   const double slipped) const
    {
      const double weakening = loss(sigma) / weakening_slip;
      if (weakening < shear_stiffness)
      {
        const double slip
            = (tau - strength(sigma, slipped)) / (shear_stiffness - weakening);
        if (slipped + slip <= weakening_slip)
          return { slip, weakening };
      }
      return { (tau - residual_strength(sigma)) / shear_stiffness, 0. };
    }
  };

  template <int dim>
  JointDissipation
  SlipWeakeningLaw::update_failing(SlipWeakeningPoint<dim> &point,
                                   const double opening,
                                   const Slip<dim> &slip) const
  {
    const Slip<dim> tau_old = point.shear_traction;
    const double sigma = normal_stiffness * (opening - point.plastic_opening);
    const Slip<dim> trial = shear_stiffness * (slip - point.plastic_slip);
    JointDissipation lost;
    if (sigma > 0.)
    {
      lost.friction         = 0.5 * tau_old * (slip - point.plastic_slip);
      point.normal_traction = 0.;
      point.shear_traction  = Slip<dim>();
      point.plastic_slip    = slip;
      point.state           = JointState::open;
      return lost;
    }
    const double sigma_old    = point.normal_traction;
    const Slip<dim> direction = direction_of(trial);
    const double dp = find_slip(sigma, magnitude(trial), point.slipped).slip;

    point.normal_traction = sigma;
    point.shear_traction  = trial - shear_stiffness * dp * direction;
    point.plastic_slip += dp * direction;
    point.slipped += dp;
    point.state = JointState::slipping;
    // The work beyond the residual strength is fracture.
    const double work = 0.5 * (tau_old + point.shear_traction) * direction * dp;
    const double residual
        = 0.5 * (residual_strength(sigma_old) + residual_strength(sigma)) * dp;
    lost.friction = std::min(work, residual);
    lost.fracture = work - lost.friction;
    return lost;
  }

  template <int dim>
  JointDissipation SlipWeakeningLaw::update(SlipWeakeningPoint<dim> &point,
                                            const double opening,
                                            const Slip<dim> &slip,
                                            JointTangent<dim> &tangent) const
  {
    const double kn = normal_stiffness, ks = shear_stiffness;
    const double sigma    = kn * (opening - point.plastic_opening);
    const double slipped  = point.slipped;
    const Slip<dim> trial = ks * (slip - point.plastic_slip);
    tangent               = { kn, {}, {}, isotropic<dim>(ks) };
    if (update_elastic(point, opening, slip))
      return {};
    const JointDissipation lost = update_failing(point, opening, slip);
    if (sigma > 0.)
    {
      tangent = {};
      return lost;
    }
    // |tau| = strength(sigma, D + dp) = |trial| - ks dp
    const Slip<dim> direction = direction_of(trial);
    const double size         = magnitude(trial);
    const Step step           = find_slip(sigma, size, slipped);
    const double left
        = std::max(0., 1. - (slipped + step.slip) / weakening_slip);
    const double by_sigma
        = -residual_friction - left * (friction - residual_friction);
    const double part     = ks / (ks - step.weakening);
    tangent.shear_opening = direction * (part * by_sigma * kn);
    tangent.shear_slip
        = -part * step.weakening * outer_product(direction, direction);
    if constexpr (dim == 3) // across the trial traction it turns
      tangent.shear_slip
          += (ks - ks * ks * step.slip / size)
             * (isotropic<dim>(1.) - outer_product(direction, direction));
    return lost;
  }

  template <int dim>
  JointDissipation
  SlipWeakeningLaw::update_waiting(SlipWeakeningPoint<dim> &point,
                                   const double opening, const Slip<dim> &slip,
                                   const JointLoss loss,
                                   JointTangent<dim> &tangent) const
  {
    if (strength(0., point.slipped) <= 0.)
      return update(point, opening, slip, tangent);
    if (loss == JointLoss::cohesion || point.state == JointState::open)
    {
      SlipWeakeningLaw law  = *this;
      law.cohesion          = 0.;
      law.residual_cohesion = 0.;
      return law.update(point, opening, slip, tangent);
    }
    if (opening <= point.plastic_opening)
      return update(point, opening, slip, tangent);
    // As if it touched without pressure.
    const JointDissipation lost
        = update(point, point.plastic_opening, slip, tangent);
    tangent.normal_opening = 0.;
    tangent.shear_opening  = Slip<dim>();
    point.state            = JointState::open;
    return lost;
  }
} // namespace quoin

#endif
