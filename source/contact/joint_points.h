// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_contact_joint_points_h
#define quoin_source_contact_joint_points_h

#include <quoin/joints/joint_history.h>
#include <quoin/operators/energy_accounts.h>
#include <quoin/joints/joint_law.h>

#include <type_traits>

// Points of all joint laws, from and to the arrays of the history.

namespace quoin
{
  template <typename Law>
  using PointOf = typename std::decay_t<Law>::template Point<2>;

  template <typename Law>
  PointOf<Law> read_point(const Law &, const JointHistory &history,
                          const unsigned int p)
  {
    using Point = PointOf<Law>;
    Point point;
    point.normal_traction = history.normal_traction[p];
    point.shear_traction  = history.shear_traction[p];
    point.plastic_slip    = history.plastic_slip[p];
    point.plastic_opening = history.plastic_opening[p];
    point.state           = history.state[p];
    for (unsigned int i = 0; i < Point::internal.size(); ++i)
      point.*Point::internal[i] = history.internal[p * history.n_internal + i];
    return point;
  }

  /** What only a failing update changes. */
  template <typename Point>
  void write_flow(const Point &point, JointHistory &history,
                  const unsigned int p)
  {
    history.plastic_slip[p]    = point.plastic_slip;
    history.plastic_opening[p] = point.plastic_opening;
    for (unsigned int i = 0; i < Point::internal.size(); ++i)
      history.internal[p * history.n_internal + i] = point.*Point::internal[i];
  }

  template <typename Point>
  void write_tractions(const Point &point, JointHistory &history,
                       const unsigned int p)
  {
    history.normal_traction[p] = point.normal_traction;
    history.shear_traction[p]  = point.shear_traction;
    history.state[p]           = point.state;
  }

  template <typename Point>
  void write_point(const Point &point, JointHistory &history,
                   const unsigned int p)
  {
    write_flow(point, history, p);
    write_tractions(point, history, p);
  }

  inline void book(const JointDissipation &lost, const double weight,
                   EnergyAccounts &energy)
  {
    energy.friction += weight * lost.friction;
    energy.fracture += weight * lost.fracture;
    energy.crushing += weight * lost.crushing;
  }

  /**
   * Brings point @p p to @p opening and @p slip [m] and books what that
   * dissipated, by the area @p weight.
   */
  template <typename Law>
  auto advance_joint(const Law &law, const double opening, const double slip,
                     const double weight, JointHistory &history,
                     const unsigned int p, EnergyAccounts &energy)
  {
    auto point = read_point(law, history, p);
    if (!law.update_elastic(point, opening, slip))
    {
      book(law.update_failing(point, opening, slip), weight, energy);
      write_flow(point, history, p);
    }
    write_tractions(point, history, p);
    return point;
  }
} // namespace quoin

#endif
