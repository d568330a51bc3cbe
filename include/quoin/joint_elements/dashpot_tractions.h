// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_dashpot_tractions_h
#define quoin_joint_elements_dashpot_tractions_h

#include <algorithm>

#include <quoin/joint_elements/joint_points.h>

namespace quoin
{
  /** Opening and slip of a joint point [m], their rates [m/s], or tractions
      [Pa]. */
  template <int dim>
  struct JointVector
  {
    double normal = 0.;
    Slip<dim> shear{};
  };

  /**
   * Tractions [Pa] of the dashpots of @p point at the opening and slip @p gap
   * [m], which change at @p rate [m/s]: the tractions that the
   * law has at the gap of @p times [s] later, at these rates, less those of
   * now. So the law bounds springs and dashpots together: they do not pull
   * beyond its tension, and friction is that of the whole pressure, also while
   * the point slips, when its friction follows the pressure at the least.
   *
   * A joint that never failed breaks by its springs alone: beyond its strength
   * the dashpots rest.
   */
  template <int dim, typename Law>
  JointVector<dim>
  dashpot_tractions(const Law &law, const PointOf<Law, dim> &point,
                    const JointVector<dim> &gap, const JointVector<dim> &rate,
                    const std::array<double, 2> &times)
  {
    const double slip_time = point.state == JointState::slipping
                                 ? std::max(times[0], times[1])
                                 : times[1];
    const double opening   = gap.normal + times[0] * rate.normal;
    const Slip<dim> slip   = gap.shear + slip_time * rate.shear;
    auto ahead             = point;
    if (!law.update_elastic(ahead, opening, slip))
    {
      if (point.state == JointState::intact)
        return {};
      law.update_failing(ahead, opening, slip);
    }
    return { ahead.normal_traction - point.normal_traction,
             ahead.shear_traction - point.shear_traction };
  }
} // namespace quoin

#endif
