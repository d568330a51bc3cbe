// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_linear_springs_h
#define quoin_joint_laws_linear_springs_h

#include <quoin/joints/joint_point.h>

#include <array>

namespace quoin
{
  /**
   * What laws of constant stiffness have in common: sigma = kn (u_n - w),
   * tau = ks (u_s - p) with opening u_n, slip u_s, plastic opening w and
   * plastic slip p.
   */
  struct LinearSprings : JointLawDefaults
  {
    double normal_stiffness = 0.; /**< kn [Pa/m] */
    double shear_stiffness  = 0.; /**< ks [Pa/m] */

    /** kn and ks [Pa/m] at the normal traction @p sigma [Pa], and at most. */
    std::array<double, 2> stiffness_at(double /*sigma*/) const
    {
      return { normal_stiffness, shear_stiffness };
    }
    std::array<double, 2> largest_stiffness() const
    {
      return { normal_stiffness, shear_stiffness };
    }

    /** Sets @p point to tractions [Pa] at rest, at zero opening and slip. */
    template <int dim>
    void initialise(JointPoint<dim> &point, const double normal,
                    const Slip<dim> &shear) const
    {
      point.normal_traction = normal;
      point.shear_traction  = shear;
      point.plastic_opening = -normal / normal_stiffness;
      point.plastic_slip    = -shear / shear_stiffness;
    }

    /** Recoverable energy per area [J/m^2] of @p point. */
    template <int dim>
    double stored_energy(const JointPoint<dim> &point,
                         double /*opening*/ = 0.) const
    {
      return carried_energy(point, point);
    }

    /** Energy per area [J/m^2] that a change of area takes along between two
        updates: of springs what is left of their trapezoidal work. */
    template <int dim>
    double carried_energy(const JointPoint<dim> &before,
                          const JointPoint<dim> &after) const
    {
      return 0.5
             * (before.normal_traction * after.normal_traction
                    / normal_stiffness
                + before.shear_traction * after.shear_traction
                      / shear_stiffness);
    }
  };
} // namespace quoin

#endif
