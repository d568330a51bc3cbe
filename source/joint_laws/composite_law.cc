// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/joint_laws/composite_return_map.h>
#include <quoin/joint_laws/law_entries.h>

#include <Eigen/LU>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Takes @p point to the end of @p flow and books what that dissipated. */
    template <int dim>
    CompositeDissipation
    accept(const CompositeReturnMap &map, const CompositeFlow &flow,
           const Slip<dim> &direction, const double opening,
           const Slip<dim> &slip, CompositePoint<dim> &point)
    {
      const CompositeLaw &law = map.law;
      const double cohesion   = 0.5 * law.cohesion * (point.bond + flow.bond);
      const double sigma      = 0.5 * (point.normal_traction + flow.sigma);
      const double tau = 0.5 * (point.shear_traction * direction + flow.tau);

      CompositeDissipation lost;
      lost.tension      = sigma * flow.opening;
      const double slid = (tau + sigma * map.dilation(flow)) * flow.slip;
      lost.shear        = std::min(slid, cohesion * flow.slip);
      lost.friction     = slid - lost.shear;
      lost.crushing
          = flow.cap
            * (sigma * (2. * law.cap.normal * flow.sigma + law.cap.offset)
               + tau * 2. * law.cap.shear * flow.tau);

      point.normal_traction = flow.sigma;
      point.shear_traction  = direction * flow.tau;
      point.plastic_opening = opening - flow.sigma / law.normal_stiffness;
      point.plastic_slip    = slip - point.shear_traction / law.shear_stiffness;
      point.bond            = flow.bond;
      point.crushing        = flow.crushing;
      if (law.cracks_close)
        point.crack_opening += flow.opening;
      if (flow.opening > 0.)
        point.state = JointState::open;
      else if (flow.slip > 0.)
        point.state = JointState::slipping;
      else if (flow.cap > 0. || point.state != JointState::intact)
        point.state = JointState::slipped;
      return lost;
    }

    /**
     * Closes the crack of @p point as far as @p opening [m] asks for; returns
     * by how much [m]. One that does not close wholly carries nothing.
     */
    template <int dim>
    double close_crack(const double opening, CompositePoint<dim> &point)
    {
      const double gap = point.plastic_opening - opening;
      if (!(gap > 0. && point.crack_opening > 0.))
        return 0.;
      const double closed   = std::min(gap, point.crack_opening);
      point.plastic_opening = closed < point.crack_opening
                                  ? opening
                                  : point.plastic_opening - closed;
      point.crack_opening -= closed;
      return closed;
    }

    /**
     * Derivative of sigma and |tau| by the two trial tractions, from the
     * equations that hold at the end of @p flow: flow rule in either
     * direction, then f_i = 0 of every surface that is active and dl_i = 0 of
     * the others. Unknowns: sigma, |tau|, kn dl1, kn dl2, kn |grad f3| dl3.
     */
    Eigen::Matrix2d differentiate(const CompositeReturnMap &map,
                                  const CompositeFlow &flow)
    {
      const CompositeLaw &law = map.law;
      const double kn = law.normal_stiffness, ks = law.shear_stiffness;
      const double bond = flow.bond;

      // bond = exp(-k), k = root((a dl1)^2 + (b dl2)^2)
      const double a = law.opening_softening(), b = law.slip_softening();
      const double growth = std::sqrt(a * a * flow.opening * flow.opening
                                      + b * b * flow.slip * flow.slip);
      const double bond_by_opening
          = growth > 0. ? -bond * a * a * flow.opening / growth : 0.;
      const double bond_by_slip
          = growth > 0. ? -bond * b * b * flow.slip / growth : 0.;

      const double psi = map.dilation(flow);
      const double psi_sigma
          = psi > 0. && flow.sigma < 0.
                ? map.free_dilation(bond) / law.dilation_pressure
                : 0.;
      const double psi_bond = bond > 0. ? map.fade * psi / bond : 0.;

      Eigen::Matrix<double, 5, 5> J = Eigen::Matrix<double, 5, 5>::Identity();
      J(0, 0) += kn * (psi_sigma * flow.slip + 2. * law.cap.normal * flow.cap);
      J(1, 1) += ks * 2. * law.cap.shear * flow.cap;
      if (flow.opening > 0.)
      {
        J(0, 2) = 1. + psi_bond * bond_by_opening * flow.slip;
        J(2, 0) = 1.;
        J(2, 2) = -law.tension * bond_by_opening / kn;
        J(2, 3) = -law.tension * bond_by_slip / kn;
      }
      if (flow.slip > 0.)
      {
        const double f_bond
            = flow.sigma * (law.friction - law.residual_friction)
              - law.cohesion;
        J(0, 3) = psi + psi_bond * bond_by_slip * flow.slip;
        J(1, 3) = ks / kn;
        J(3, 0) = law.friction_at(bond);
        J(3, 1) = 1.;
        J(3, 2) = f_bond * bond_by_opening / kn;
        J(3, 3) = f_bond * bond_by_slip / kn;
      }
      if (flow.cap > 0.)
      {
        const double normal = 2. * law.cap.normal * flow.sigma + law.cap.offset;
        const double shear  = 2. * law.cap.shear * flow.tau;
        const double norm   = std::sqrt(normal * normal + shear * shear);
        double slope;
        const double limit = law.cap.limit(flow.crushing, slope);
        const double drop  = 2. * limit * slope / norm;
        const double part  = 2. * drop * flow.cap;
        J(0, 4)            = normal / norm;
        J(1, 4)            = ks / kn * shear / norm;
        J(4, 0)            = normal / norm * (1. - part * law.cap.normal);
        J(4, 1)            = shear / norm * (1. - part * law.cap.shear);
        J(4, 4)            = -drop / kn;
      }
      Eigen::Matrix<double, 5, 2> trial = Eigen::Matrix<double, 5, 2>::Zero();
      trial(0, 0) = trial(1, 1) = 1.;
      return J.fullPivLu().solve(trial).topRows<2>();
    }

    /**
     * A step that is not elastic: the crack closes first, then the joint is
     * elastic or fails. @p tangent holds the elastic one.
     */
    template <bool with_tangent, int dim>
    CompositeDissipation advance(const CompositeLaw &law,
                                 CompositePoint<dim> &point,
                                 const double opening, const Slip<dim> &slip,
                                 JointTangent<dim> &tangent)
    {
      const double kn = law.normal_stiffness, ks = law.shear_stiffness;
      const double sigma_before = point.normal_traction;
      const double closed       = close_crack(opening, point);

      CompositeDissipation lost;
      const Slip<dim> trial_tau = ks * (slip - point.plastic_slip);
      if (closed == 0. || !law.update_elastic(point, opening, slip))
      {
        const Slip<dim> direction = direction_of(trial_tau);
        const CompositeReturnMap map(law, point.bond, point.crushing,
                                     kn * (opening - point.plastic_opening),
                                     magnitude(trial_tau));
        const CompositeFlow flow = map.end();
        if (with_tangent)
        {
          const Eigen::Matrix2d D = differentiate(map, flow);
          tangent                 = { D(0, 0) * kn, D(0, 1) * ks * direction,
                                      D(1, 0) * kn * direction,
                                      D(1, 1) * ks * outer_product(direction, direction) };
          if constexpr (dim == 3) // across the trial traction it turns
            if (const double trial = magnitude(trial_tau); trial > 0.)
              tangent.shear_slip += ks * flow.tau / trial
                                    * (isotropic<dim>(1.)
                                       - outer_product(direction, direction));
        }
        lost = accept<dim>(map, flow, direction, opening, slip, point);
      }
      if (closed > 0.)
        lost.tension -= 0.5 * (sigma_before + point.normal_traction) * closed;
      if (closed > 0. && point.crack_opening > 0.) // carries nothing
      {
        point.state            = JointState::open;
        tangent.normal_opening = 0.;
        tangent.shear_opening  = Slip<dim>();
      }
      return lost;
    }
  } // namespace

  double CompositeCap::limit(const double crushing, double &slope) const
  {
    slope = 0.;
    if (std::isinf(compression))
      return compression;
    const double first = compression / 3., middle = compression / 2.,
                 last = compression / 7.;
    const double km   = middle_crushing();
    if (crushing < peak_crushing)
    {
      const double x    = crushing / peak_crushing;
      const double root = std::sqrt(x * (2. - x));
      slope = (compression - first) * (1. - x) / (peak_crushing * root);
      return first + (compression - first) * root;
    }
    const double width = km - peak_crushing;
    if (crushing < km)
    {
      const double x = (crushing - peak_crushing) / width;
      slope          = 2. * (middle - compression) * x / width;
      return compression + (middle - compression) * x * x;
    }
    const double m     = 2. * (middle - compression) / width;
    const double decay = std::exp(m * (crushing - km) / (middle - last));
    slope              = m * decay;
    return last + (middle - last) * decay;
  }

  bool softens_gently(const CompositeLaw &law, const double sigma)
  {
    const CompositeCap &cap = law.cap;
    const double loss
        = law.cohesion - sigma * (law.friction - law.residual_friction);
    return law.normal_stiffness > law.tension * law.opening_softening()
           && law.shear_stiffness > loss * law.slip_softening()
           && (std::isinf(cap.compression)
               || law.normal_stiffness > cap.steepest());
  }

  CompositeLaw CompositeLaw::read(LawEntries &entries)
  {
    CompositeLaw law;
    double angle = 0., dilation_angle = 0.;
    entries.positive("Normal stiffness", law.normal_stiffness,
                     "normal stiffness kn", "Pa/m");
    entries.positive("Shear stiffness", law.shear_stiffness,
                     "shear stiffness ks", "Pa/m");
    entries.nonnegative("Tensile strength", law.tension, "tensile strength ft",
                        "Pa");
    entries.positive_or_none(
        "Tensile fracture energy", law.tension_energy,
        "mode I fracture energy GfI, or 'none' if tension does not soften",
        "J/m^2");
    entries.nonnegative("Cohesion", law.cohesion, "peak cohesion c", "Pa");
    entries.positive_or_none(
        "Shear fracture energy", law.shear_energy,
        "mode II fracture energy GfII, or 'none' if cohesion does not soften",
        "J/m^2");
    entries.within("Friction angle", angle, 0., 89., "friction angle phi",
                   "deg");
    double residual = angle;
    entries.angle_or_same(
        "Residual friction angle", residual,
        "friction angle of the failed joint, at most 'Friction angle' where it "
        "loses no cohesion, or "
        "'same' as it");
    entries.check_residual_angle(residual, angle, law.cohesion > 0.);
    law.friction          = tangent_of_degrees(angle);
    law.residual_friction = tangent_of_degrees(residual);
    entries.check(law.tension * std::max(law.friction, law.residual_friction)
                      <= law.cohesion,
                  "Tensile strength",
                  "must not exceed 'Cohesion' over the tangent of the friction "
                  "angle, where shear strength ends.");

    entries.within("Dilation angle", dilation_angle, 0.,
                   std::min(angle, residual),
                   "dilation angle psi, at most the smaller of the friction "
                   "angles before and after failure",
                   "deg");
    law.dilation = tangent_of_degrees(dilation_angle);
    entries.positive_or_none(
        "Dilation pressure", law.dilation_pressure,
        "pressure above which the joint no longer dilates, or 'none' if it "
        "dilates under any pressure",
        "Pa");
    entries.nonnegative("Dilation decay", law.dilation_decay,
                        "degradation coefficient delta of dilation with slip, "
                        "which needs 'Cohesion' and 'Shear fracture energy'",
                        "1/m");
    entries.either("Cracks", law.cracks_close, "stay open", "close",
                   "behaviour of tensile cracks at unloading. stay open: "
                   "unloading is elastic and compression returns before the "
                   "crack is closed, as published; close: the crack first "
                   "closes without resistance, for cyclic loading");

    entries.positive_or_none("Compressive strength", law.cap.compression,
                             "compressive strength fm of the masonry, or "
                             "'none' if it does not crush",
                             "Pa");
    if (entries.reads() && std::isinf(law.cap.compression))
    {
      entries.refuse_numbers({ "Compressive fracture energy", "Peak crushing" },
                             "Compressive strength");
      return law;
    }
    entries.positive("Compressive fracture energy", law.cap.compression_energy,
                     "compressive fracture energy Gfc", "J/m^2");
    entries.positive("Peak crushing", law.cap.peak_crushing,
                     "plastic closure kappa_p at the compressive strength",
                     "m");
    entries.positive("Cap shear", law.cap.shear,
                     "coefficient Css of the shear traction in the cap", "-");
    entries.positive("Cap normal", law.cap.normal,
                     "coefficient Cnn of the normal traction in the cap", "-");
    entries.nonnegative(
        "Cap offset", law.cap.offset,
        "coefficient Cn of the cap, whose centre is at -Cn/(2 Cnn); not "
        "negative",
        "Pa");
    return law;
  }

  std::string CompositeLaw::text() const
  {
    return "composite, " + named_number("tensile strength", tension, "Pa")
           + ", " + named_number("cohesion", cohesion, "Pa") + ", "
           + named_number("friction angle",
                          std::atan(friction) / constants::degree, "degrees")
           + ", " + named_number("compressive strength", cap.compression, "Pa");
  }

  std::string CompositeLaw::warning() const
  {
    /** Closure that no mortar bears before its strength [m]. */
    constexpr double most_closure = 5e-3;
    if (std::isfinite(cap.compression) && cap.peak_crushing > most_closure)
      return "'Peak crushing', the plastic closure at the compressive "
             "strength, is far more than usual: in mm it would be "
             + number_text(1e-3 * cap.peak_crushing)
             + " m. The joint crushes long before that. Check the unit.";
    if (softens_gently(*this))
      return "";
    return "the joint drops by itself at failure and does not dissipate its "
           "fracture energies. 'Normal stiffness' should be above ft^2 / GfI = "
           + number_text(tension * tension / tension_energy) + " Pa/m"
           + (std::isinf(cap.compression)
                  ? std::string()
                  : " and above the slope of the cap, "
                        + number_text(cap.steepest()) + " Pa/m")
           + ", 'Shear stiffness' above c^2 / GfII = "
           + number_text(cohesion * cohesion / shear_energy) + " Pa/m.";
  }

  CompositeLaw CompositeLaw::reduced(const double factor) const
  {
    CompositeLaw weak = *this;
    weak.tension /= factor;
    weak.cohesion /= factor;
    weak.friction /= factor;
    weak.residual_friction /= factor;
    weak.dilation
        = std::min(dilation, std::min(weak.friction, weak.residual_friction));
    return weak;
  }

  template <int dim>
  CompositeDissipation CompositeLaw::update_failing(CompositePoint<dim> &point,
                                                    const double opening,
                                                    const Slip<dim> &slip) const
  {
    JointTangent<dim> unused;
    return advance<false>(*this, point, opening, slip, unused);
  }

  template <int dim>
  CompositeDissipation
  CompositeLaw::update(CompositePoint<dim> &point, const double opening,
                       const Slip<dim> &slip, JointTangent<dim> &tangent) const
  {
    tangent = { normal_stiffness, {}, {}, isotropic<dim>(shear_stiffness) };
    return update_elastic(point, opening, slip)
               ? CompositeDissipation()
               : advance<true>(*this, point, opening, slip, tangent);
  }

  template CompositeDissipation
  CompositeLaw::update_failing(CompositePoint<2> &, double,
                               const Slip<2> &) const;
  template CompositeDissipation
  CompositeLaw::update_failing(CompositePoint<3> &, double,
                               const Slip<3> &) const;
  template CompositeDissipation CompositeLaw::update(CompositePoint<2> &,
                                                     double, const Slip<2> &,
                                                     JointTangent<2> &) const;
  template CompositeDissipation CompositeLaw::update(CompositePoint<3> &,
                                                     double, const Slip<3> &,
                                                     JointTangent<3> &) const;
} // namespace quoin
