// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_joint_response_h
#define quoin_source_joint_elements_joint_response_h

#include <quoin/joint_elements/joint_points.h>
#include <quoin/joint_elements/space_joint_history.h>

#include <cmath>

namespace quoin
{
  /**
   * How an increment counts that adds to @p total: as more of it, so that
   * slip on the way back does not, or by its size where there is none yet.
   */
  inline double sign_of_growth(const double total, const double increment)
  {
    return total != 0.       ? std::copysign(1., total)
           : increment != 0. ? std::copysign(1., increment)
                             : 0.;
  }
  template <int n>
  dealii::Tensor<1, n> sign_of_growth(const dealii::Tensor<1, n> &total,
                                      const dealii::Tensor<1, n> &increment)
  {
    const dealii::Tensor<1, n> &along = total.norm() > 0. ? total : increment;
    return along.norm() > 0. ? along / along.norm() : along;
  }

  /** A joint point updated for its gap, and the derivatives there. */
  template <int dim>
  struct JointResponse
  {
    JointTangent<dim> tangent;
    std::array<double, 2> stiffness; /**< kn, ks of the moment [Pa/m] */
    Slip<dim> slip_by_pressure;      /**< derivative in the law [m/Pa] */
    double plastic_opening;          /**< increment [m] */
    Slip<dim> plastic_slip;          /**< increment [m] */
    double opens;                    /**< sign_of_growth() of these */
    Slip<dim> slips;

    /** What its inelastic opening and slip grew by [m]. */
    double growth() const
    {
      return opens * plastic_opening + slips * plastic_slip;
    }
  };

  /** Updates point @p p of @p history for @p opening and @p slip [m]; one that
      waits does so for its @p loss. Books @p weight times the dissipation. */
  template <int dim, typename Law, typename History>
  JointResponse<dim> respond(const Law &law, const double opening,
                             const Slip<dim> &slip, const JointLoss loss,
                             const double weight, History &history,
                             const unsigned int p, EnergyAccounts &energy)
  {
    auto point                 = read_point(law, history, p);
    const double total_opening = point.plastic_opening;
    const Slip<dim> total_slip = point.plastic_slip;
    const Slip<dim> slip_done  = plastic_slip_done(history, p);
    JointResponse<dim> result;
    JointDissipation lost;
    if constexpr (Law::waits)
      lost = law.update_waiting(point, opening, slip, loss, result.tangent);
    else
      lost = law.update(point, opening, slip, result.tangent);
    book(lost, weight, energy);
    write_point(point, history, p);
    result.stiffness        = law.stiffness_at(point.normal_traction);
    result.slip_by_pressure = law.slip_by_pressure(point);
    result.plastic_opening  = point.plastic_opening - total_opening;
    result.plastic_slip     = point.plastic_slip - total_slip;
    // An open joint may keep the plastic opening that it had.
    result.opens = result.plastic_opening == 0.
                       ? 0.
                       : sign_of_growth(total_opening, result.plastic_opening);
    result.slips = sign_of_growth(slip_done, result.plastic_slip);
    return result;
  }
} // namespace quoin

#endif
