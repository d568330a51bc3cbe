// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_composite_law_h
#define quoin_joint_laws_composite_law_h

#include <quoin/joint_laws/coulomb_law.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace quoin
{
  /** One point of a masonry joint, which remembers how far it softened. */
  template <int dim>
  struct CompositePoint : JointPoint<dim>
  {
    double bond     = 1.; /**< ft/ft0 = c/c0 = exp(-k) [-] */
    double crushing = 0.; /**< k3 [m] */
    /** Part of w that tension opened and closing recovers [m]. */
    double crack_opening = 0.;

    static constexpr std::array<double CompositePoint::*, 3> internal
        = { &CompositePoint::bond, &CompositePoint::crushing,
            &CompositePoint::crack_opening };
  };

  /** Energy per area that an update dissipated [J/m^2]. */
  struct CompositeDissipation
  {
    double tension  = 0.; /**< fracture, mode I */
    double shear    = 0.; /**< loss of cohesion, mode II */
    double friction = 0.; /**< slip beyond that, and its dilation */
    double crushing = 0.; /**< work of crushing on the cap */

    double total() const
    {
      return tension + shear + friction + crushing;
    }
    operator JointDissipation() const
    {
      return { friction, tension + shear, crushing };
    }
  };

  /** The elliptic cap of a composite law, on which masonry crushes. */
  struct CompositeCap
  {
    /** fm [Pa]; infinite: no cap */
    double compression        = std::numeric_limits<double>::infinity();
    double compression_energy = 0.; /**< Gfc [J/m^2] */
    double peak_crushing      = 0.; /**< k3 at fm, kp [m] */
    double normal             = 1.; /**< Cnn */
    double shear              = 9.; /**< Css */
    double offset             = 0.; /**< Cn [Pa] */

    /** cap(k3) [Pa] and its slope [Pa/m] at @p crushing [m]. */
    double limit(double crushing, double &slope) const;
    double limit(const double crushing) const
    {
      double slope;
      return limit(crushing, slope);
    }

    /** k3 at which the cap has softened to fm/2, km [m]. */
    double middle_crushing() const
    {
      return 75. / 67. * compression_energy / compression + peak_crushing;
    }

    /** Steepest descent of cap(k3) [Pa/m]. */
    double steepest() const
    {
      return compression / (middle_crushing() - peak_crushing);
    }

    /** Below this the cap is never reached [Pa^2]. */
    double lowest_load() const
    {
      return compression * compression / 49.;
    }

    /** Value that is compared with the square of the cap [Pa^2]. */
    double load(const double sigma, const double tau) const
    {
      return (normal * sigma + offset) * sigma + shear * tau * tau;
    }
  };

  /**
   * The composite interface law for masonry joints of @cite LourencoRots1997
   * and @cite Lourenco1996: tension cut-off, Coulomb friction and an elliptic
   * cap, each with hardening or softening.
   *
   * sigma = kn (u_n - w), tau = ks (u_s - p). With k1, k2 and k3,
   *
   *     f1 = sigma - ft,                      ft = ft0 exp(-ft0 k1/GfI),
   *     f2 = |tau| + sigma tan(phi) - c,      c  = c0 exp(-c0 k2/GfII),
   *     f3 = Cnn sigma^2 + Css tau^2 + Cn sigma - cap(k3)^2,
   *
   * tan(phi) going from its peak to its residual value as c goes to zero. f1
   * and f3 are associated; f2 flows with tan(psi). Tension and shear soften
   * together, k1 = k2 (GfI c0)/(GfII ft0), so that ft/ft0 = c/c0 for good and
   * one number, the @em bond, stands for both.
   *
   * Unloading is elastic with the first stiffness. In the published law plastic
   * opening stays, and a crack that closes carries compression as soon as
   * u_n < w. With @p cracks_close what tension opened closes without
   * resistance first: at sigma = 0, down to what dilation and crushing left.
   *
   * Strengths and stiffnesses are finite, energies positive (infinite: that
   * mode does not soften), ft0 tan(phi) <= c0, and tan(psi0) <= tan(phi), or
   * slip could create energy.
   *
   * What an update returns is dissipated by the trapezoidal rule, so that
   * work = change of stored_energy() + total() to rounding. An increment can
   * be negative only if the step jumps across the elastic range.
   */
  struct CompositeLaw : LinearSprings
  {
    template <int dim>
    using Point = CompositePoint<dim>;

    static constexpr const char *kind = "a composite law";
    static constexpr std::array<LawName, 1> names
        = { { { "composite",
                "cohesion, friction and tension that soften with fracture "
                "energies, and a compressive cap, for masonry" } } };
    static constexpr bool bridges = true;

    static constexpr double infinity = std::numeric_limits<double>::infinity();

    double tension           = 0.;       /**< ft0 [Pa] */
    double tension_energy    = infinity; /**< GfI [J/m^2] */
    double cohesion          = 0.;       /**< c0 [Pa] */
    double shear_energy      = infinity; /**< GfII [J/m^2] */
    double friction          = 0.;       /**< tan(phi0) */
    double residual_friction = 0.;       /**< tan(phi_r) */

    double dilation = 0.; /**< tan(psi0) */
    /** Pressure where dilation ends, sigma_u [Pa]. */
    double dilation_pressure = infinity;
    double dilation_decay = 0.; /**< decay of dilation with k2, delta [1/m] */

    CompositeCap cap;

    bool cracks_close = false;

    /** The law of a set of joints, or its entries of the parameter file. */
    static CompositeLaw read(LawEntries &entries);

    /** Description of the law for --check. */
    std::string text() const;

    /** Warning about a strength that drops abruptly; empty: it softens
     * gradually. */
    std::string warning() const;

    /** Strengths divided by @p factor, peak and residual, without the cap;
        dilation is not above the friction that is left. */
    CompositeLaw reduced(double factor) const;

    /** The cap does not count: neither tension nor slip takes any of it. */
    JointBehaviour behaviour() const
    {
      JointBehaviour result;
      result.loses_strength
          = tension > 0. || cohesion > 0. || friction != residual_friction;
      return result;
    }

    /** New contacts have no bond, but an intact cap. */
    template <int dim>
    void wear_out(CompositePoint<dim> &point) const
    {
      point.bond = 0.;
    }

    /** Quantities of a point for results. */
    template <int dim>
    static std::array<JointField<CompositePoint<dim>>, 2> fields()
    {
      using Here = CompositePoint<dim>;
      return { { { "damage", [](const Here &p) { return 1. - p.bond; } },
                 { "crushing", [](const Here &p) { return p.crushing; } } } };
    }

    /** Updates @p point for @p opening and @p slip [m]. */
    template <int dim>
    CompositeDissipation update(CompositePoint<dim> &point, double opening,
                                const Slip<dim> &slip) const;

    /** As update(), with the consistent tangent; see CoulombLaw. */
    template <int dim>
    CompositeDissipation update(CompositePoint<dim> &point, double opening,
                                const Slip<dim> &slip,
                                JointTangent<dim> &tangent) const;

    /** As update(), if the joint is elastic there and no crack closes; else it
        returns false. */
    template <int dim>
    bool update_elastic(CompositePoint<dim> &point, double opening,
                        const Slip<dim> &slip) const;

    /** As update(), for a joint that fails or closes. */
    template <int dim>
    CompositeDissipation update_failing(CompositePoint<dim> &point,
                                        double opening,
                                        const Slip<dim> &slip) const;

    /** Whether the tractions of @p point, if it is intact, are admissible,
       without regard to the cap. */
    template <int dim>
    bool holds(const CompositePoint<dim> &point) const
    {
      return JointStrength{ cohesion, friction, tension }.bears(
          point.normal_traction, magnitude(point.shear_traction));
    }

    /**
     * How fast opening and slip alone use the bond up [1/m]; together by
     * dk = root((a dl1)^2 + (b dl2)^2), bond = exp(-k).
     */
    double opening_softening() const
    {
      return tension > 0. ? tension / tension_energy : 0.;
    }
    double slip_softening() const
    {
      return cohesion > 0. ? cohesion / shear_energy : 0.;
    }

    /** tan(phi) at what is left of the @p bond. */
    double friction_at(const double bond) const
    {
      return residual_friction + (friction - residual_friction) * bond;
    }
  };

  /**
   * Whether no mode of @p law can snap back: GfI kn > ft0^2, GfII ks > c0^2 and
   * kn above the steepest slope of the cap. Otherwise the law drops at
   * failure however small the step; it stays defined, but dissipates other
   * than the fracture energy. No length comes in. Shear allows for friction
   * that softens at the normal traction @p sigma [Pa].
   */
  bool softens_gently(const CompositeLaw &law, double sigma = 0.);

  template <int dim>
  inline bool CompositeLaw::update_elastic(CompositePoint<dim> &point,
                                           const double opening,
                                           const Slip<dim> &slip) const
  {
    const double sigma  = normal_stiffness * (opening - point.plastic_opening);
    const Slip<dim> tau = shear_stiffness * (slip - point.plastic_slip);
    const double size   = magnitude(tau);
    const double load   = cap.load(sigma, size);
    if (sigma < 0. && point.crack_opening > 0.)
      return false;
    if (!(sigma <= tension * point.bond
          && size <= cohesion * point.bond - sigma * friction_at(point.bond)))
      return false;
    // The cap itself needs a root or an exponential: only near it.
    if (!(load <= cap.lowest_load()))
    {
      const double limit = cap.limit(point.crushing);
      if (!(load <= limit * limit))
        return false;
    }
    point.normal_traction = sigma;
    point.shear_traction  = tau;
    if (point.state != JointState::intact)
      point.state = sigma > 0. ? JointState::open : JointState::slipped;
    return true;
  }

  template <int dim>
  inline CompositeDissipation CompositeLaw::update(CompositePoint<dim> &point,
                                                   const double opening,
                                                   const Slip<dim> &slip) const
  {
    return update_elastic(point, opening, slip)
               ? CompositeDissipation()
               : update_failing(point, opening, slip);
  }
} // namespace quoin

#endif
