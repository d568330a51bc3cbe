// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/joints/composite_return_map.h>

#include <Eigen/LU>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Takes @p point to the end of @p flow and books what that dissipated. */
    CompositeDissipation accept(const CompositeReturnMap &map,
                                const CompositeFlow &flow,
                                const double direction, const double opening,
                                const double slip, CompositePoint &point)
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
            * (sigma * (2. * law.cap_normal * flow.sigma + law.cap_offset)
               + tau * 2. * law.cap_shear * flow.tau);

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
    double close_crack(const double opening, CompositePoint &point)
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
      J(0, 0) += kn * (psi_sigma * flow.slip + 2. * law.cap_normal * flow.cap);
      J(1, 1) += ks * 2. * law.cap_shear * flow.cap;
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
        const double normal = 2. * law.cap_normal * flow.sigma + law.cap_offset;
        const double shear  = 2. * law.cap_shear * flow.tau;
        const double norm   = std::sqrt(normal * normal + shear * shear);
        double slope;
        const double limit = law.cap(flow.crushing, slope);
        const double drop  = 2. * limit * slope / norm;
        const double part  = 2. * drop * flow.cap;
        J(0, 4)            = normal / norm;
        J(1, 4)            = ks / kn * shear / norm;
        J(4, 0)            = normal / norm * (1. - part * law.cap_normal);
        J(4, 1)            = shear / norm * (1. - part * law.cap_shear);
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
    template <bool with_tangent>
    CompositeDissipation advance(const CompositeLaw &law, CompositePoint &point,
                                 const double opening, const double slip,
                                 JointTangent &tangent)
    {
      const double kn = law.normal_stiffness, ks = law.shear_stiffness;
      const double sigma_before = point.normal_traction;
      const double closed       = close_crack(opening, point);

      CompositeDissipation lost;
      const double trial_tau = ks * (slip - point.plastic_slip);
      if (closed == 0. || !law.update_elastic(point, opening, slip))
      {
        const double direction = trial_tau < 0. ? -1. : 1.;
        const CompositeReturnMap map(law, point,
                                     kn * (opening - point.plastic_opening),
                                     std::abs(trial_tau));
        const CompositeFlow flow = map.end();
        if (with_tangent)
        {
          const Eigen::Matrix2d D = differentiate(map, flow);
          tangent                 = { D(0, 0) * kn, D(0, 1) * ks * direction,
                                      D(1, 0) * kn * direction, D(1, 1) * ks };
        }
        lost = accept(map, flow, direction, opening, slip, point);
      }
      if (closed > 0.)
        lost.tension -= 0.5 * (sigma_before + point.normal_traction) * closed;
      if (closed > 0. && point.crack_opening > 0.) // carries nothing
      {
        point.state            = JointState::open;
        tangent.normal_opening = tangent.shear_opening = 0.;
      }
      return lost;
    }
  } // namespace

  double CompositeLaw::cap(const double crushing, double &slope) const
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

  bool CompositeLaw::softens_gently(const double sigma) const
  {
    const double steepest_cap
        = compression / (middle_crushing() - peak_crushing);
    const double loss = cohesion - sigma * (friction - residual_friction);
    return normal_stiffness > tension * opening_softening()
           && shear_stiffness > loss * slip_softening()
           && (std::isinf(compression) || normal_stiffness > steepest_cap);
  }

  CompositeDissipation CompositeLaw::update_failing(CompositePoint &point,
                                                    const double opening,
                                                    const double slip) const
  {
    JointTangent unused;
    return advance<false>(*this, point, opening, slip, unused);
  }

  CompositeDissipation CompositeLaw::update(CompositePoint &point,
                                            const double opening,
                                            const double slip,
                                            JointTangent &tangent) const
  {
    tangent = { normal_stiffness, 0., 0., shear_stiffness };
    return update_elastic(point, opening, slip)
               ? CompositeDissipation()
               : advance<true>(*this, point, opening, slip, tangent);
  }
} // namespace quoin
