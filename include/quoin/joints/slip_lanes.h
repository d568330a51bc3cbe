// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_slip_lanes_h
#define quoin_joints_slip_lanes_h

#include <quoin/base/lane_functions.h>
#include <quoin/joints/joint_point.h>

namespace quoin
{
  /**
   * A Slip of @p dim dimensions in each lane, with the functions that
   * joint_point.h has for one. In arrays the components of a point lie one
   * behind the other.
   */
  template <int lanes, int dim>
  struct SlipLanes
  {
    static constexpr int n = dim - 1;
    static_assert(n == 1 || n == 2);
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;

    Value component[n];

    static QUOIN_INLINE SlipLanes load(const double *from)
    {
      if constexpr (n == 1)
        return { { F::load(from) } };
      else
      {
        SlipLanes slips;
        F::load_pairs(from, slips.component[0], slips.component[1]);
        return slips;
      }
    }
    QUOIN_INLINE void store(double *to) const
    {
      if constexpr (n == 1)
        F::store(to, component[0]);
      else
        F::store_pairs(to, component[0], component[1]);
    }
    /** Stores the lanes of @p mask; the others keep what they have. */
    QUOIN_INLINE void store(double *to, const Bits &mask) const
    {
      if constexpr (n == 1)
        F::store(to, component[0], mask);
      else
        choose(mask, *this, load(to)).store(to);
    }

    /** @p a in the lanes of @p mask, else @p b. */
    static QUOIN_INLINE SlipLanes choose(const Bits &mask, const SlipLanes &a,
                                         const SlipLanes &b)
    {
      SlipLanes result;
      for (int c = 0; c < n; ++c)
        result.component[c] = mask ? a.component[c] : b.component[c];
      return result;
    }

    /** The slip in lane @p l. */
    Slip<dim> at(const int l) const
    {
      if constexpr (n == 1)
        return F::at(component[0], l);
      else
      {
        Slip<dim> result;
        for (int c = 0; c < n; ++c)
          result[c] = F::at(component[c], l);
        return result;
      }
    }
    void set(const int l, const Slip<dim> &slip)
    {
      if constexpr (n == 1)
        component[0][l] = slip;
      else
        for (int c = 0; c < n; ++c)
          component[c][l] = slip[c];
    }

    friend QUOIN_INLINE SlipLanes operator+(const SlipLanes &a,
                                            const SlipLanes &b)
    {
      SlipLanes result;
      for (int c = 0; c < n; ++c)
        result.component[c] = a.component[c] + b.component[c];
      return result;
    }
    friend QUOIN_INLINE SlipLanes operator-(const SlipLanes &a,
                                            const SlipLanes &b)
    {
      SlipLanes result;
      for (int c = 0; c < n; ++c)
        result.component[c] = a.component[c] - b.component[c];
      return result;
    }
    /** @p factor: a number, or one for each lane. */
    template <typename Factor>
    friend QUOIN_INLINE SlipLanes operator*(const Factor &factor,
                                            const SlipLanes &a)
    {
      SlipLanes result;
      for (int c = 0; c < n; ++c)
        result.component[c] = factor * a.component[c];
      return result;
    }
    friend QUOIN_INLINE SlipLanes operator/(const SlipLanes &a,
                                            const double divisor)
    {
      SlipLanes result;
      for (int c = 0; c < n; ++c)
        result.component[c] = a.component[c] / divisor;
      return result;
    }
    /** The scalar product. */
    friend QUOIN_INLINE Value dot(const SlipLanes &a, const SlipLanes &b)
    {
      if constexpr (n == 1)
        return a.component[0] * b.component[0];
      else
        return a.component[0] * b.component[0]
               + a.component[1] * b.component[1];
    }

    friend QUOIN_INLINE Value magnitude(const SlipLanes &a)
    {
      if constexpr (n == 1)
        return F::absolute(a.component[0]);
      else
        return F::square_root(dot(a, a));
    }
    /** Whether magnitude(a) <= @p limit, in space without a root. */
    friend QUOIN_INLINE Bits is_within(const SlipLanes &a, const Value &limit)
    {
      if constexpr (n == 1)
        return F::absolute(a.component[0]) <= limit;
      else
        return dot(a, a) <= limit * F::absolute(limit);
    }
    /** @p size: magnitude(a) */
    friend QUOIN_INLINE SlipLanes direction_of(const SlipLanes &a,
                                               const Value &size)
    {
      const Value none{};
      if constexpr (n == 1)
        return { { a.component[0] < 0. ? none - 1. : none + 1. } };
      else
      {
        const Bits is_long = size > 0.;
        return { { is_long ? a.component[0] / size : none + 1.,
                   is_long ? a.component[1] / size : none } };
      }
    }
    /** See joint_point.h. */
    friend QUOIN_INLINE Value growth(const SlipLanes &direction,
                                     const SlipLanes &before,
                                     const SlipLanes &after)
    {
      const Value none{};
      const Value size = magnitude(before) + magnitude(after);
      return size > 0. ? dot(direction, before + after) / size : none + 1.;
    }
  };
} // namespace quoin

#endif
