// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_space_face_lanes_h
#define quoin_source_joint_elements_space_face_lanes_h

#include <quoin/base/lane_functions.h>
#include <quoin/joint_elements/face_groups.h>

#include "face_nodes.h"

// The geometry of space_face.h for several faces at once, one in each lane.

namespace quoin
{
  template <int lanes>
  struct SpaceFaceLanes
  {
    static constexpr unsigned int dim = 3;
    using F                           = LaneFunctions<lanes>;
    using L                           = Lanes<lanes>;
    using Value                       = typename F::Value;
    using Bits                        = typename F::Bits;
    using Group                       = FaceGroup<dim, lanes>;

    Value n[3], s[3], t[3]; /**< see FaceFrame */
    // The edges E1 and E2 are here the sums of those of both sides, twice the
    // mean ones of FaceFrame.
    Value inverse_length, inverse_above; /**< of E1, of E2 across it [1/m] */
    Value along;                         /**< of E2 [m] */
    Value opening[3], slip[2][3];        /**< of the points; along s, t [m] */

    /** Lanes that are not @p present have frames and gaps of zero. */
    QUOIN_INLINE SpaceFaceLanes(const Group &group, const FaceNodes<3> &nodes,
                                const Bits &present)
    {
      Value gap[3][4], e[2][3];
      load(group, nodes, gap, e);
      set_frame(e[0], e[1], present);
      for (unsigned int k = 0; k < 3; ++k)
      {
        opening[k] = dot(gap[k], n);
        slip[0][k] = dot(gap[k], s);
        slip[1][k] = dot(gap[k], t);
      }
    }

    /** Adds what the resultants @p sigma and @p tau (along s, t) [N] at the
        points do to the nodes, with the couple of the frame. */
    QUOIN_INLINE void add_forces(const Group &group, const Value (&sigma)[3],
                                 const Value (&tau)[2][3],
                                 FaceNodes<3> &nodes) const
    {
      Value about_n{}, about_s{}, about_t{};
      for (unsigned int k = 0; k < 3; ++k)
      {
        about_n += tau[0][k] * slip[1][k] - tau[1][k] * slip[0][k];
        about_s += tau[1][k] * opening[k] - sigma[k] * slip[1][k];
        about_t += sigma[k] * slip[0][k] - tau[0][k] * opening[k];
      }
      // See couple_forces().
      const Value lift = about_s * inverse_above;
      const Value turn = inverse_length * (about_t + lift * along);
      const Value spin = inverse_length * about_n;
      for (unsigned int k = 0; k < 3; ++k)
      {
        Value own[4]{}, couple[4]{};
        for (unsigned int d = 0; d < 3; ++d)
        {
          own[d]    = sigma[k] * n[d] + tau[0][k] * s[d] + tau[1][k] * t[d];
          couple[d] = k == 0   ? spin * t[d] - (turn - lift) * n[d]
                      : k == 1 ? turn * n[d] - spin * t[d]
                               : -lift * n[d];
        }
        nodes.add(group.pairs[k], own, couple);
      }
    }

    /** Rates [m/s] of the openings and slips of the points; @p nodes have
        velocities. */
    QUOIN_INLINE void find_rates(const Group &group, const FaceNodes<3> &nodes,
                                 Value (&opening_rate)[3],
                                 Value (&slip_rate)[2][3]) const
    {
      Value rate[3][4], edge[2][3];
      load(group, nodes, rate, edge);
      // How fast the frame turns; see rotation_rate() of space_joints.cc.
      const Value about_t = -dot(edge[0], n) * inverse_length;
      const Value about_s = (dot(edge[1], n) + about_t * along) * inverse_above;
      const Value about_n = dot(edge[0], t) * inverse_length;
      for (unsigned int k = 0; k < 3; ++k)
      {
        opening_rate[k]
            = dot(rate[k], n) - (about_s * slip[1][k] - about_t * slip[0][k]);
        slip_rate[0][k]
            = dot(rate[k], s) - (about_t * opening[k] - about_n * slip[1][k]);
        slip_rate[1][k]
            = dot(rate[k], t) - (about_n * slip[0][k] - about_s * opening[k]);
      }
    }

  private:
    template <typename A, typename B>
    static QUOIN_INLINE Value dot(const A &a, const B &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static QUOIN_INLINE void cross(const Value (&a)[3], const Value (&b)[3],
                                   Value (&c)[3])
    {
      c[0] = a[1] * b[2] - a[2] * b[1];
      c[1] = a[2] * b[0] - a[0] * b[2];
      c[2] = a[0] * b[1] - a[1] * b[0];
    }

    /** Gaps of the vertices, and the edges from the first to the second and to
        the third one, summed up over both sides; or their rates. */
    static QUOIN_INLINE void load(const Group &group, const FaceNodes<3> &nodes,
                                  Value (&gap)[3][4], Value (&edge)[2][3])
    {
      Value sum[3][4];
      for (unsigned int k = 0; k < 3; ++k)
        nodes.motion(group.pairs[k], gap[k], sum[k]);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int d = 0; d < 3; ++d)
          edge[i][d] = sum[i + 1][d] - sum[0][d];
    }

    /** Finds the frame as frame_of() does, with one division for all inverses.
     */
    QUOIN_INLINE void set_frame(const Value (&e1)[3], const Value (&e2)[3],
                                const Bits &present)
    {
      cross(e1, e2, n);
      const Value square = dot(e1, e1);
      const Value length = F::square_root(square);
      const Value size   = F::square_root(dot(n, n));
      const Value none{};
      const Value inverse = present ? 1. / (length * size) : none;
      inverse_length      = size * inverse;
      inverse_above       = square * inverse;
      for (unsigned int d = 0; d < 3; ++d)
      {
        s[d] = e1[d] * inverse_length;
        n[d] *= length * inverse;
      }
      cross(n, s, t);
      along = dot(e2, s);
    }
  };
} // namespace quoin

#endif
