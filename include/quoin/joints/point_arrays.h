// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_point_arrays_h
#define quoin_joints_point_arrays_h

#include <quoin/joints/joint_history.h>

#include <array>
#include <type_traits>

// Points of all joint laws, from and to the arrays of a history.

namespace quoin
{
  template <typename Law>
  using PointOf = typename std::decay_t<Law>::template Point<2>;

  /** Pointers to the arrays of a JointHistory, or of a part of it. */
  struct PointArrays
  {
    static constexpr unsigned int most_internal = 4;

    struct Variable
    {
      double *values;
    };

    double *normal_traction;
    double *shear_traction;
    double *plastic_slip;
    double *plastic_opening;
    std::array<Variable, most_internal> internal;
    JointState *state;

    /** Arrays from point @p p on. */
    PointArrays from(const unsigned int p) const
    {
      PointArrays part{
        normal_traction + p, shear_traction + p, plastic_slip + p,
        plastic_opening + p, internal,           state + p
      };
      for (Variable &variable : part.internal)
        variable.values += p;
      return part;
    }
  };

  /** @p History: JointHistory or PointArrays, here and below. */
  template <typename Law, typename History>
  PointOf<Law> read_point(const Law &, const History &history,
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
      point.*Point::internal[i] = history.internal[i].values[p];
    return point;
  }

  template <typename Point, typename History>
  void write_point(const Point &point, History &history, const unsigned int p)
  {
    history.normal_traction[p] = point.normal_traction;
    history.shear_traction[p]  = point.shear_traction;
    history.plastic_slip[p]    = point.plastic_slip;
    history.plastic_opening[p] = point.plastic_opening;
    history.state[p]           = point.state;
    for (unsigned int i = 0; i < Point::internal.size(); ++i)
      history.internal[i].values[p] = point.*Point::internal[i];
  }
} // namespace quoin

#endif
