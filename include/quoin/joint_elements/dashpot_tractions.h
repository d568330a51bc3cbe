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
   * The part of @p times [s], normal and shear, in which springs that stiffen
   * gain as much as those of now, at the normal traction @p sigma [Pa], would
   * in all of them: a dashpot stays T times the stiffness of now. Closing at
   * @p closing [m/s].
   */
  template <typename Law>
  std::array<double, 2> times_of_springs(const Law &law, const double sigma,
                                         const double closing,
                                         const std::array<double, 2> &times)
  {
    if constexpr (Law::stiffens)
      if (closing > 0. && times[0] > 0.)
      {
        const double pressure = std::max(0., -sigma);
        const auto [kn, ks]   = law.stiffness_at(-pressure);
        const double ahead    = pressure + kn * times[0] * closing;
        return { (law.closure.closure(ahead) - law.closure.closure(pressure))
                     / closing,
                 times[1] * ks / law.stiffness_at(-ahead)[1] };
      }
    return times;
  }

  /**
   * @p point after the largest shares of the @p change of the opening, then of
   * the slip at the @p gap [m] that leave it elastic; as it is if it is not
   * elastic at the gap.
   */
  template <int dim, typename Law>
  PointOf<Law, dim>
  within_strength(const Law &law, const PointOf<Law, dim> &point,
                  const JointVector<dim> &gap, const JointVector<dim> &change)
  {
    PointOf<Law, dim> elastic = point;
    double shares[2]          = { 0., 0. };
    for (double &share : shares)
    {
      const auto bears = [&](const double part)
      {
        share                 = part;
        PointOf<Law, dim> now = point;
        const bool is_elastic
            = law.update_elastic(now, gap.normal + shares[0] * change.normal,
                                 gap.shear + shares[1] * change.shear);
        if (is_elastic)
          elastic = now;
        return is_elastic;
      };
      if (bears(1.))
        continue;
      double low = 0., high = 1.;
      while (high - low > 1e-15)
        (bears(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
      share = low;
    }
    return elastic;
  }

  /**
   * Tractions [Pa] of the dashpots of @p point at the opening and slip @p gap
   * [m], which change at @p rate [m/s]: the tractions that the
   * law has at the gap of @p times_of_now [s] later, at these rates, less those
   * of now. So the law bounds springs and dashpots together: they do not pull
   * beyond its tension, and friction is that of the whole pressure, also while
   * the point slips, when its friction follows the pressure at the least. Laws
   * that stiffen are asked sooner, see times_of_springs().
   *
   * A joint that never failed breaks by its springs alone: if failure takes
   * strength, springs and dashpots together stay within that of now, normal
   * first, see within_strength().
   */
  template <int dim, typename Law>
  JointVector<dim>
  dashpot_tractions(const Law &law, const PointOf<Law, dim> &point,
                    const JointVector<dim> &gap, const JointVector<dim> &rate,
                    const std::array<double, 2> &times_of_now)
  {
    const auto times       = times_of_springs(law, point.normal_traction,
                                              -rate.normal, times_of_now);
    const double slip_time = point.state == JointState::slipping
                                 ? std::max(times[0], times[1])
                                 : times[1];
    const double opening   = gap.normal + times[0] * rate.normal;
    const Slip<dim> slip   = gap.shear + slip_time * rate.shear;
    auto ahead             = point;
    if (!law.update_elastic(ahead, opening, slip))
    {
      // Rock joints, which stiffen, have no strength to break.
      if (point.state == JointState::intact && !Law::stiffens
          && law.behaviour().loses_strength)
        ahead = within_strength<dim>(
            law, point, gap, { opening - gap.normal, slip - gap.shear });
      else
        law.update_failing(ahead, opening, slip);
    }
    return { ahead.normal_traction - point.normal_traction,
             ahead.shear_traction - point.shear_traction };
  }
} // namespace quoin

#endif
