// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_point_arrays_h
#define quoin_joints_point_arrays_h

#include <quoin/base/packed_vectors.h>
#include <quoin/joints/joint_point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

// Points of all joint laws, from and to the arrays of a history.

namespace quoin
{
  /** The point of @p Law in @p dim dimensions. */
  template <typename Law, int dim = 2>
  using PointOf = typename std::decay_t<Law>::template Point<dim>;

  /** Pointers to the arrays of a joint history in @p dim dimensions, or of a
      part of it. Shear tractions and slips have dim - 1 entries a point. */
  template <int dim>
  struct PointArrays
  {
    static constexpr int dimension              = dim;
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
      PointArrays part{ normal_traction + p,
                        shear_traction + (dim - 1) * p,
                        plastic_slip + (dim - 1) * p,
                        plastic_opening + p,
                        internal,
                        state + p };
      for (double *&variable : part.internal)
        if (variable)
          variable += p;
      return part;
    }
  };

  template <typename History>
  PointArrays<History::dimension> arrays_of(History &history)
  {
    PointArrays<History::dimension> result{ history.normal_traction.data(),
                                            history.shear_traction.data(),
                                            history.plastic_slip.data(),
                                            history.plastic_opening.data(),
                                            {},
                                            history.state.data() };
    for (unsigned int i = 0; i < result.most_internal; ++i)
      result.internal[i]
          = history.internal[i].empty() ? nullptr : history.internal[i].data();
    return result;
  }

  template <int dim>
  void copy_points(const PointArrays<dim> &from, const PointArrays<dim> &to,
                   const unsigned int n)
  {
    std::copy_n(from.normal_traction, n, to.normal_traction);
    std::copy_n(from.shear_traction, (dim - 1) * n, to.shear_traction);
    std::copy_n(from.plastic_slip, (dim - 1) * n, to.plastic_slip);
    std::copy_n(from.plastic_opening, n, to.plastic_opening);
    std::copy_n(from.state, n, to.state);
    for (unsigned int i = 0; i < from.most_internal; ++i)
      if (from.internal[i] && to.internal[i])
        std::copy_n(from.internal[i], n, to.internal[i]);
  }

  /** Arrays of @p n points of their own. */
  template <int n, int dim>
  struct PointPack
  {
    static constexpr unsigned int most_internal
        = PointArrays<dim>::most_internal;
    alignas(64) double normal_traction[n]{};
    alignas(64) double shear_traction[(dim - 1) * n]{};
    alignas(64) double plastic_slip[(dim - 1) * n]{};
    alignas(64) double plastic_opening[n]{};
    alignas(64) double internal[most_internal][n]{};
    JointState state[n]{};

    PointArrays<dim> arrays()
    {
      PointArrays<dim> result{ normal_traction,
                               shear_traction,
                               plastic_slip,
                               plastic_opening,
                               {},
                               state };
      for (unsigned int i = 0; i < most_internal; ++i)
        result.internal[i] = internal[i];
      return result;
    }
  };

  /** A slip or a shear traction out of an array of them, and into it. */
  template <int dim, typename Values>
  Slip<dim> slip_at(const Values &values, const unsigned int p)
  {
    if constexpr (dim == 2)
      return values[p];
    else
      return vector_at<dim - 1>(values, p);
  }
  template <int dim, typename Values>
  void set_slip(Values &values, const unsigned int p, const Slip<dim> &slip)
  {
    if constexpr (dim == 2)
      values[p] = slip;
    else
      set_vector(values, p, slip);
  }

  /** The @p slip [m] of point @p p of @p history as laws count it: from where a
      block was placed beside it, if a stage did that. */
  template <typename History>
  Slip<History::dimension> slip_since_placing(const History &history,
                                              const unsigned int p,
                                              Slip<History::dimension> slip)
  {
    if (!history.placed_slip.empty())
      slip -= slip_at<History::dimension>(history.placed_slip, p);
    return slip;
  }

  /** The plastic slip that point @p p has done [m]. */
  template <typename History>
  Slip<History::dimension> plastic_slip_done(const History &history,
                                             const unsigned int p)
  {
    /** By the plastic slip, up to which a difference is one of rounding. */
    constexpr double rounding = 1e-12;
    const auto size           = [](const Slip<History::dimension> &slip)
    {
      if constexpr (History::dimension == 2)
        return std::abs(slip);
      else
        return slip.norm();
    };
    const auto slip = slip_at<History::dimension>(history.plastic_slip, p);
    if (history.elastic_origin.empty())
      return slip;
    const auto done
        = slip - slip_at<History::dimension>(history.elastic_origin, p);
    return size(done) > rounding * size(slip) ? done
                                              : Slip<History::dimension>();
  }

  /** Takes a change of the plastic slip of point @p p of @p history by @p
     change [m] for none that it has done; @p n: number of points. */
  template <typename History>
  void move_elastic_origin(const Slip<History::dimension> &change,
                           const std::size_t n, History &history,
                           const unsigned int p)
  {
    constexpr int dim = History::dimension;
    history.elastic_origin.resize((dim - 1) * n, 0.);
    set_slip<dim>(history.elastic_origin, p,
                  slip_at<dim>(history.elastic_origin, p) + change);
  }

  /** @p History: JointHistory, SpaceJointHistory or PointArrays, here and
      below. */
  template <typename Law, typename History>
  PointOf<Law, History::dimension>
  read_point(const Law &, const History &history, const unsigned int p)
  {
    constexpr int dim = History::dimension;
    using Point       = PointOf<Law, dim>;
    Point point;
    point.normal_traction = history.normal_traction[p];
    point.shear_traction  = slip_at<dim>(history.shear_traction, p);
    point.plastic_slip    = slip_at<dim>(history.plastic_slip, p);
    point.plastic_opening = history.plastic_opening[p];
    point.state           = history.state[p];
    for (unsigned int i = 0; i < Point::internal.size(); ++i)
      point.*Point::internal[i] = history.internal[i][p];
    return point;
  }

  template <typename Point, typename History>
  void write_point(const Point &point, History &history, const unsigned int p)
  {
    constexpr int dim          = History::dimension;
    history.normal_traction[p] = point.normal_traction;
    set_slip<dim>(history.shear_traction, p, point.shear_traction);
    set_slip<dim>(history.plastic_slip, p, point.plastic_slip);
    history.plastic_opening[p] = point.plastic_opening;
    history.state[p]           = point.state;
    for (unsigned int i = 0; i < Point::internal.size(); ++i)
      history.internal[i][p] = point.*Point::internal[i];
  }
} // namespace quoin

#endif
