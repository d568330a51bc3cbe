// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_point_arrays_h
#define quoin_joints_point_arrays_h

#include <quoin/joints/joint_history.h>

#include <algorithm>
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
    static constexpr unsigned int most_internal = JointHistory::most_internal;

    double *normal_traction;
    double *shear_traction;
    double *plastic_slip;
    double *plastic_opening;
    std::array<double *, most_internal> internal; /**< null: none has it */
    JointState *state;

    /** Arrays from point @p p on. */
    PointArrays from(const unsigned int p) const
    {
      PointArrays part{
        normal_traction + p, shear_traction + p, plastic_slip + p,
        plastic_opening + p, internal,           state + p
      };
      for (double *&variable : part.internal)
        if (variable)
          variable += p;
      return part;
    }
  };

  inline PointArrays arrays_of(JointHistory &history)
  {
    PointArrays result{ history.normal_traction.data(),
                        history.shear_traction.data(),
                        history.plastic_slip.data(),
                        history.plastic_opening.data(),
                        {},
                        history.state.data() };
    for (unsigned int i = 0; i < PointArrays::most_internal; ++i)
      result.internal[i]
          = history.internal[i].empty() ? nullptr : history.internal[i].data();
    return result;
  }

  inline void copy_points(const PointArrays &from, const PointArrays &to,
                          const unsigned int n)
  {
    std::copy_n(from.normal_traction, n, to.normal_traction);
    std::copy_n(from.shear_traction, n, to.shear_traction);
    std::copy_n(from.plastic_slip, n, to.plastic_slip);
    std::copy_n(from.plastic_opening, n, to.plastic_opening);
    std::copy_n(from.state, n, to.state);
    for (unsigned int i = 0; i < PointArrays::most_internal; ++i)
      if (from.internal[i] && to.internal[i])
        std::copy_n(from.internal[i], n, to.internal[i]);
  }

  /** Arrays of @p n points of their own. */
  template <int n>
  struct PointPack
  {
    alignas(64) double values[4 + PointArrays::most_internal][n]{};
    JointState state[n]{};

    PointArrays arrays()
    {
      PointArrays result{
        values[0], values[1], values[2], values[3], {}, state
      };
      for (unsigned int i = 0; i < PointArrays::most_internal; ++i)
        result.internal[i] = values[4 + i];
      return result;
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
      point.*Point::internal[i] = history.internal[i][p];
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
      history.internal[i][p] = point.*Point::internal[i];
  }
} // namespace quoin

#endif
